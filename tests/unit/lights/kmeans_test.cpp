// Methods kmeans-2d and kmeans-3d; tests/unit/kmeans is about how they cluster.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "../expect_error.h"
#include "../synthetic_room.h"
#include "math/lobe.h"
#include "stages/lights/lights.h"

namespace vsgl {
namespace {

using interop::Light;

gpu::Device& device() {
  static gpu::Device instance({.compute_only = true});
  return instance;
}

LightsParams params_of(const char* method, int count) {
  LightsParams params;
  params.method = method;
  params.count = count;
  return params;
}

Lights generate(const Rsm& rsm, const Pdf& pdf, const LightsParams& params) {
  Report report;
  return generate_lights(rsm, &pdf, params, &device(), report);
}

Vec3 power_of(const Light& light) {
  return test::to_double(light.power_diffuse) + test::to_double(light.power_specular);
}

// Power of the lights of one layer over what the layer reflects.
double power_ratio(const Rsm& rsm, const Lights& lights, std::size_t layer) {
  double sum = 0;
  for (const Light& light : lights.lights)
    if (light.layer == layer) sum += luminance(power_of(light));
  const interop::Moments& top = rsm.layers[layer].pyramid.back();
  return sum / (static_cast<double>(top.weight) * rsm.size * rsm.size);
}

// One density for all texels of the first `layers` layers, none elsewhere.
Pdf density_of_first(const Rsm& rsm, std::size_t layers) {
  std::vector<std::vector<double>> values;
  for (std::size_t k = 0; k < rsm.layers.size(); ++k)
    values.emplace_back(rsm.texel_count() / rsm.layers.size(), k < layers ? 1.0 : 0.0);
  return test::make_pdf(rsm, values);
}

TEST(KmeansLights, ConserveThePowerOfTheRsm) {
  const Rsm rsm = test::room_rsm(128);
  for (const char* method : {"kmeans-2d", "kmeans-3d"})
    for (const int count : {1, 100, 5000})
      for (const Pdf& pdf : {test::flux_pdf(rsm), density_of_first(rsm, 1)})
        EXPECT_NEAR(power_ratio(rsm, generate(rsm, pdf, params_of(method, count)), 0), 1, 1e-6)
            << method << " " << count;
}

TEST(KmeansLights, KeepThePowerOfEachLayerIn2D) {
  const Rsm rsm = test::room_rsm(64, 2);
  for (const std::size_t layers : {1u, 2u}) {
    const Lights lights = generate(rsm, density_of_first(rsm, layers), params_of("kmeans-2d", 50));
    EXPECT_LE(lights.lights.size(), 50u);
    for (const std::size_t layer : {0u, 1u}) EXPECT_NEAR(power_ratio(rsm, lights, layer), 1, 1e-6) << layers;
  }
}

// Word by word; merging a texel with nothing rounds once or twice.
void expect_equal(const Light& a, const Light& b) {
  const auto *x = reinterpret_cast<const float*>(&a), *y = reinterpret_cast<const float*>(&b);
  for (std::size_t k = 0; k < sizeof(Light) / sizeof(float); ++k)
    EXPECT_LE(std::abs(x[k] - y[k]), 1e-5f * std::abs(y[k])) << "word " << k << " of texel " << b.texel;
}

// As many samples that each texel is a centre: what method texels gives, in another order.
TEST(KmeansLights, AreTheTexelsWhereEachIsACluster) {
  const Rsm rsm = test::room_rsm(16, 2);
  const Pdf pdf = density_of_first(rsm, 2);
  auto texels = generate(rsm, pdf, params_of("texels", 1)).lights;
  const auto place = [](const Light& l) { return std::pair(l.layer, l.texel); };
  for (const char* method : {"kmeans-2d", "kmeans-3d"}) {
    auto lights = generate(rsm, pdf, params_of(method, 8192)).lights;
    std::ranges::sort(lights, {}, place);
    ASSERT_EQ(lights.size(), texels.size()) << method;
    for (std::size_t i = 0; i < texels.size(); ++i) expect_equal(lights[i], texels[i]);
  }
}

// The texels that represent lights lie in their clusters: near the means, as seen from far.
TEST(KmeansLights, AreRepresentedByOneOfTheirTexels) {
  const Rsm rsm = test::room_rsm(64);
  LightsParams params = params_of("kmeans-3d", 300);
  for (params.kmeans_iterations = 0; params.kmeans_iterations <= 2; params.kmeans_iterations += 2)
    for (const Light& light : generate(rsm, test::flux_pdf(rsm), params).lights) {
      const interop::Surface& surface = rsm.layers[light.layer].surface[light.texel];
      EXPECT_EQ(test::to_double(light.origin), test::to_double(surface.position));
      EXPECT_EQ(light.alpha, surface.alpha);
      EXPECT_EQ(light.ndf, surface.ndf);
      EXPECT_LT(length(test::to_double(light.origin) - test::to_double(light.position)), 0.5);
    }
}

// Normals in the distance keep walls apart: clusters across an edge of the room go.
TEST(KmeansLights, NormalsSeparateWalls) {
  const Rsm rsm = test::room_rsm(64);
  const auto bent = [&](double normal_weight) {
    LightsParams params = params_of("kmeans-3d", 300);
    params.kmeans_normal_weight = normal_weight;
    double power = 0;
    for (const Light& light : generate(rsm, test::flux_pdf(rsm), params).lights)
      if (light.normal_deficit > 0.05f) power += luminance(power_of(light));
    return power;
  };
  EXPECT_GT(bent(0), 0);
  EXPECT_LT(bent(1), 0.5 * bent(0));
}

SgLobe specular_lobe_of(const interop::Moments& m) {
  return lobe_decode({test::to_double(m.specular_mean), static_cast<double>(m.specular_deficit)});
}

// Of all texels' specular lobes, in double precision.
SgLobe mean_specular_lobe(const Rsm& rsm, const std::string& lobe_filter) {
  const std::uint32_t kind = lobe_filter_kind(lobe_filter);
  Vec3 sum;
  double power = 0;
  for (std::size_t i = 0; i < rsm.layers[0].surface.size(); ++i) {
    const interop::Moments& m = rsm.layers[0].pyramid[i];
    const double weight = luminance(test::to_double(m.power_specular));
    if (weight <= 0) continue;
    const SgLobe lobe = specular_lobe_of(m);
    sum += lobe_encode_by(kind, lobe.axis, lobe.sharpness).mean * weight;
    power += weight;
  }
  const Vec3 mean = sum / power;
  return lobe_decode_by(kind, {mean, 1 - dot(mean, mean)});
}

// One cluster holds all lobes.
TEST(KmeansLights, AverageLobesByTheMapOfChoice) {
  const Rsm rsm = test::room_rsm(32);
  std::set<float> found;
  for (const char* lobe_filter : {"banerjee", "toksvig", "laurijssen"}) {
    LightsParams params = params_of("kmeans-3d", 1);
    params.lobe_filter = lobe_filter;
    const Light light = generate(rsm, test::flux_pdf(rsm), params).lights.at(0);
    const SgLobe exact = mean_specular_lobe(rsm, lobe_filter);
    EXPECT_NEAR(static_cast<double>(light.specular_sharpness) / exact.sharpness, 1, 1e-3) << lobe_filter;
    EXPECT_LT(length(test::to_double(light.specular_axis) - exact.axis), 1e-3) << lobe_filter;
    found.insert(light.specular_sharpness);
  }
  EXPECT_EQ(found.size(), 3u);
}

TEST(KmeansLights, LeaveTheLobesOfTheNearestTexelUnfiltered) {
  const Rsm rsm = test::room_rsm(64);
  LightsParams params = params_of("kmeans-2d", 300);
  params.lobe_filter = "none";
  int specular = 0;
  for (const Light& light : generate(rsm, test::flux_pdf(rsm), params).lights) {
    const interop::Moments& own = rsm.layers[light.layer].pyramid[light.texel];
    EXPECT_NEAR(light.diffuse_sharpness, interop::LAMBDA_DIFFUSE, 1e-4);
    if (test::to_double(own.specular_mean) == Vec3{}) continue;
    EXPECT_NEAR(static_cast<double>(light.specular_sharpness) / specular_lobe_of(own).sharpness, 1, 1e-3);
    ++specular;
  }
  EXPECT_GT(specular, 50);
}

TEST(KmeansLights, RefuseParametersOutOfRange) {
  const Rsm rsm = test::room_rsm(16, 2);
  const Pdf pdf = test::flux_pdf(rsm);
  const auto refuse = [&](const LightsParams& params, const std::vector<std::string>& fragments) {
    test::expect_error(ErrorCode::out_of_range, fragments, [&] { generate(rsm, pdf, params); });
  };
  LightsParams params = params_of("kmeans-2d", 8);
  params.kmeans_iterations = 21;
  refuse(params, {"kmeans_iterations: 21", "0..20"});
  params.kmeans_iterations = 0;
  params.kmeans_normal_weight = -1;
  refuse(params, {"kmeans_normal_weight"});
  refuse(params_of("kmeans-2d", 1), {"count: 1", "kmeans-2d"});
}

}  // namespace
}  // namespace vsgl
