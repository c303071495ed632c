#include "stages/pdf/pdf.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "../expect_error.h"
#include "../synthetic_room.h"
#include "math/light_source.h"
#include "math/sg.h"
#include "stages/pdf/importons.h"
#include "stages/pdf/methods.h"

namespace vsgl {
namespace {

using interop::Surface;
using test::to_double;

gpu::Device& device() {
  static gpu::Device device({.compute_only = true});
  return device;
}

PdfParams params_of(const std::string& method) {
  PdfParams params;
  params.method = method;
  params.gbuffer_lights = 128;
  return params;
}

Pdf build(const Rsm& rsm, const GBuffer& gbuffer, const PdfParams& params) {
  Report report;
  return build_pdf(rsm, &gbuffer, params, device(), report);
}

double mean_of(const Pdf& pdf) {
  double sum = 0;
  for (const Pdf::Layer& layer : pdf.layers)
    for (int k = 0; k < pdf.size * pdf.size; ++k)
      sum += static_cast<double>(layer.pyramid[static_cast<std::size_t>(k)]);
  return sum / (pdf.size * pdf.size * static_cast<double>(pdf.layers.size()));
}

// A corner of the room stays dark.
Rsm partly_lit_room(int size) {
  Rsm rsm = test::room_rsm(size, 2);
  std::vector<DoubleMoments> level0;
  for (int k = 0; k < size * size; ++k) {
    const interop::Moments& m = rsm.layers[0].pyramid[static_cast<std::size_t>(k)];
    const Surface& s = rsm.layers[0].surface[static_cast<std::size_t>(k)];
    const Vec3 incident = direction_to_source(rsm.layers[0].light, to_double(s.position));
    level0.push_back(k % size < 5 ? DoubleMoments{}
                                  : test::reflect(s, to_double(m.flux), incident, m.spread));
  }
  rsm.layers[0].pyramid = test::moment_pyramid(std::move(level0), size);
  return rsm;
}

TEST(Pdf, EveryMethodGivesADensity) {
  const Rsm rsm = partly_lit_room(32);
  const GBuffer gbuffer = test::room_gbuffer(40, 24);
  for (const PdfMethod& method : pdf_methods()) {
    const Pdf pdf = build(rsm, gbuffer, params_of(method.name));
    EXPECT_EQ(pdf.method, method.name);
    EXPECT_NEAR(mean_of(pdf), 1, 1e-6) << method.name;
    ASSERT_EQ(pdf.layers.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(pdf.layers[k].name, rsm.layers[k].name);
      ASSERT_EQ(pdf.layers[k].pyramid.size(), pyramid_texels(32));
      for (std::size_t i = 0; i < 32 * 32; ++i)
        ASSERT_EQ(pdf.layers[k].pyramid[i] > 0, rsm.layers[k].pyramid[i].weight > 0)
            << method.name << " " << i;
    }
  }
}

// No light of N samples is brighter than 1 / defensive times its share: W / p <= mean(W) / defensive.
TEST(Pdf, TheDefensiveMixtureBoundsEveryLight) {
  const Rsm rsm = test::room_rsm(32, 2);
  const double mean_power = test::reflected_power(rsm) / static_cast<double>(rsm.texel_count());
  for (const char* method : {"brsm-vpl", "brsm-vsgl"})
    for (const double share : {0.1, 0.3, 1.0}) {
      PdfParams params = params_of(method);
      params.defensive = share;
      const Pdf pdf = build(rsm, test::room_gbuffer(32, 32), params);
      double worst = 0;
      for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t i = 0; i < 32 * 32; ++i)
          worst = std::max<double>(worst, rsm.layers[k].pyramid[i].weight / pdf.layers[k].pyramid[i]);
      EXPECT_LE(worst, mean_power / share * 1.00001) << method;
      EXPECT_GT(worst, mean_power) << "of unequal densities some light is brighter than the mean";
    }
}

// --- one pixel and one texel: the two roles are interchangeable ---

struct Pair {
  Rsm rsm;
  GBuffer gbuffer;
  Surface texel, pixel;
  Vec3 incident, view;  // at the texel towards the source, at the pixel towards the camera
};

Surface make_surface(Vec3 position, Vec3 normal, Vec3 diffuse, Vec3 specular, std::uint32_t ndf,
                     float alpha) {
  Surface s{};
  s.position = test::to_float(position);
  s.normal = s.shading_normal = test::to_float(normalise(normal));
  s.diffuse = test::to_float(diffuse);
  s.specular = test::to_float(specular);
  s.ndf = ndf;
  s.alpha = alpha;
  return s;
}

Pair make_pair(bool specular) {
  const std::uint32_t ndf = specular ? interop::NDF_GGX : interop::NDF_NONE;
  const Vec3 gloss = specular ? Vec3{0.5, 0.3, 0.4} : Vec3{};
  Pair pair;
  pair.texel = make_surface({0.2, 0, 0.1}, {0.1, 1, 0}, {0.8, 0.2, 0.3}, gloss, ndf, specular ? 0.35f : 1.0f);
  pair.pixel =
      make_surface({-0.7, 1.1, 0.9}, {0.6, -0.5, -0.6}, {0.3, 0.6, 0.5}, gloss, ndf, specular ? 0.3f : 1.0f);
  LightSource lamp;
  lamp.name = "lamp";
  lamp.position = {1, 2, -0.5};
  RsmLayer layer{"lamp", lamp, {pair.texel}, {}};
  pair.incident = direction_to_source(lamp, to_double(pair.texel.position));
  layer.pyramid = {test::to_float(test::reflect(pair.texel, {3, 4, 5}, pair.incident, 0))};
  pair.rsm.size = pair.rsm.width = pair.rsm.height = 1;
  pair.rsm.scene_radius = pair.gbuffer.scene_radius = 1;
  pair.rsm.layers = {layer};
  pair.gbuffer.width = pair.gbuffer.height = 1;
  pair.gbuffer.camera = {0.5, -0.2, -0.3};
  pair.gbuffer.pixels = {pair.pixel};
  pair.view = normalise(pair.gbuffer.camera - to_double(pair.pixel.position));
  return pair;
}

// BRDF times cosine towards w, RGB.
Vec3 exact_reflection(const Surface& s, Vec3 incident, Vec3 w) {
  const Vec3 n = to_double(s.normal);
  Vec3 value = to_double(s.diffuse) * (std::max(dot(n, w), 0.0) / std::numbers::pi);
  if (s.ndf != interop::NDF_NONE)
    value += to_double(s.specular) * specular_brdf_cos(s.ndf, s.alpha, n, incident, w);
  return value;
}
// The same with both lobes as normalised SGs.
Vec3 sg_reflection(const Surface& s, Vec3 incident, Vec3 w) {
  const Vec3 n = to_double(s.normal);
  const double lambda = interop::LAMBDA_DIFFUSE;
  Vec3 value = to_double(s.diffuse) * (sg_value(w, n, lambda) / sg_integral(lambda));
  if (s.ndf == interop::NDF_NONE) return value;
  const SgLobe lobe = specular_lobe(s.ndf, s.alpha, n, incident);
  return value +
         to_double(s.specular) * (sg_value(w, lobe.axis, lobe.sharpness) / sg_integral(lobe.sharpness));
}

// Luminance of the light that the texel, as a virtual point light, sends to the camera by the pixel.
template <class Reflection>
double direct_contribution(const Pair& pair, Reflection of_pixel) {
  const Vec3 v = to_double(pair.pixel.position) - to_double(pair.texel.position), w = normalise(v);
  const Vec3 emitted = Vec3{3, 4, 5} * exact_reflection(pair.texel, pair.incident, w);
  return luminance(emitted * of_pixel(pair.pixel, pair.view, -w)) / dot(v, v);
}

TEST(Pdf, RolesOfPixelAndTexelAreInterchangeable) {
  for (const bool specular : {false, true}) {
    const Pair pair = make_pair(specular);
    Report report;
    const PdfParams params = params_of("brsm-vsgl");
    const double by_vsgl = brsm_vsgl_values(pair.rsm, &pair.gbuffer, params, device(), report)[0][0];
    const double by_vpl = brsm_vpl_values(pair.rsm, &pair.gbuffer, params, device(), report)[0][0];
    const double exact = direct_contribution(pair, exact_reflection),
                 sg = direct_contribution(pair, sg_reflection);
    EXPECT_NEAR(by_vpl / exact, 1, 1e-4);
    EXPECT_NEAR(by_vsgl / sg, 1, specular ? 1e-3 : 1e-4);
  }
}

// --- against brute force: all pairs of texel and pixel, exact BRDFs ---

TEST(Pdf, ImportanceFollowsTheExactContributions) {
  const Rsm rsm = test::room_rsm(16);
  const GBuffer gbuffer = test::room_gbuffer(32, 32);
  std::vector<double> exact;
  double exact_sum = 0;
  for (std::size_t i = 0; i < 256; ++i) {
    const Surface& texel = rsm.layers[0].surface[i];
    const Vec3 incident = direction_to_source(rsm.layers[0].light, to_double(texel.position));
    double sum = 0;
    for (const Surface& pixel : gbuffer.pixels) {
      const Vec3 v = to_double(pixel.position) - to_double(texel.position), w = normalise(v);
      const Vec3 emitted = to_double(rsm.layers[0].pyramid[i].flux) * exact_reflection(texel, incident, w);
      const Vec3 view = normalise(gbuffer.camera - to_double(pixel.position));
      sum += luminance(emitted * exact_reflection(pixel, view, -w)) /
             std::max(dot(v, v), std::pow(0.05 * 3.2, 2));
    }
    exact.push_back(sum);
    exact_sum += sum;
  }
  const auto distance = [&](const PdfParams& params) {  // total variation
    const Pdf pdf = build(rsm, gbuffer, params);
    double sum = 0;
    for (std::size_t i = 0; i < 256; ++i)
      sum += std::abs(static_cast<double>(pdf.layers[0].pyramid[i]) / 256 - exact[i] / exact_sum) / 2;
    return sum;
  };
  PdfParams by_vpl = params_of("brsm-vpl"), by_vsgl = params_of("brsm-vsgl");
  by_vpl.defensive = by_vsgl.defensive = 0;
  by_vsgl.gbuffer_lights = 1024;
  for (const GbufferGeneration& generation : gbuffer_generations()) {
    by_vsgl.gbuffer_generation = generation.name;
    EXPECT_LT(distance(by_vsgl), 0.15) << generation.name;
  }
  EXPECT_LT(distance(by_vpl), 0.2);
  by_vpl.view_samples = 20000;  // every pixel several times
  EXPECT_LT(distance(by_vpl), 0.02);
  EXPECT_GT(distance(params_of("uniform")), 0.25);
}

// --- lights on the G-buffer, by each generation ---

std::vector<interop::Importon> importons_of(const GBuffer& gbuffer, const std::string& generation,
                                            int lights) {
  Report report;
  return make_importons(gbuffer, {.gbuffer_lights = lights, .gbuffer_generation = generation}, device(),
                        report);
}

Vec3 power_of(const interop::Importon& importon) {
  return to_double(importon.diffuse_peak) * sg_integral(importon.diffuse_sharpness) +
         to_double(importon.specular_peak) * sg_integral(importon.specular_sharpness);
}

Vec3 reflectance(const Surface& pixel) {
  return to_double(pixel.diffuse) + to_double(pixel.specular);
}

// Power of the lights over what all pixels reflect.
double power_ratio(const GBuffer& gbuffer, const std::vector<interop::Importon>& importons) {
  double emitted = 0, reflected = 0;
  for (const interop::Importon& importon : importons) emitted += luminance(power_of(importon));
  for (const Surface& pixel : gbuffer.pixels) reflected += luminance(reflectance(pixel));
  return emitted / reflected;
}

TEST(GbufferLights, ClustersKeepThePowerOfTheImage) {
  const GBuffer gbuffer = test::room_gbuffer(64, 36);
  for (const char* generation : {"kmeans-2d", "kmeans-3d"})
    for (const int lights : {1, 100, 5000})
      EXPECT_NEAR(power_ratio(gbuffer, importons_of(gbuffer, generation, lights)), 1, 1e-5)
          << generation << " " << lights;
}

// Where all pixels reflect alike each kernel is right by any rule.
TEST(GbufferLights, KernelsKeepThePowerOfAnEvenImage) {
  GBuffer gbuffer = test::room_gbuffer(64, 64);
  for (Surface& pixel : gbuffer.pixels) {
    pixel.diffuse = {0.5f, 0.4f, 0.3f};
    pixel.specular = {};
    pixel.ndf = interop::NDF_NONE;
  }
  for (const GbufferGeneration& generation : gbuffer_generations())
    EXPECT_NEAR(power_ratio(gbuffer, importons_of(gbuffer, generation.name, 64)), 1, 1e-5) << generation.name;
}

// As many samples that each pixel is a cluster of its own: the lights are the pixels.
TEST(GbufferLights, ArePixelsWhereEachIsACluster) {
  const GBuffer gbuffer = test::room_gbuffer(16, 16);
  for (const char* generation : {"kmeans-2d", "kmeans-3d"}) {
    const auto importons = importons_of(gbuffer, generation, 16384);
    ASSERT_EQ(importons.size(), gbuffer.pixels.size()) << generation;
    for (const Surface& pixel : gbuffer.pixels) {
      const auto distance = [&](const interop::Importon& i) {
        return length(to_double(i.position) - to_double(pixel.position));
      };
      const interop::Importon& importon = *std::ranges::min_element(importons, {}, distance);
      EXPECT_LT(distance(importon), 1e-5);
      EXPECT_LT(length(power_of(importon) - reflectance(pixel)), 1e-5);
      EXPECT_LT(length(to_double(importon.diffuse_axis) - to_double(pixel.normal)), 1e-5);
      EXPECT_NEAR(importon.diffuse_sharpness, interop::LAMBDA_DIFFUSE, 1e-4);
    }
  }
}

// Mean variance of the lights' footprints, weighted by power.
double mean_variance(const std::vector<interop::Importon>& importons) {
  double sum = 0, power = 0;
  for (const interop::Importon& importon : importons) {
    sum += luminance(power_of(importon)) * static_cast<double>(importon.variance);
    power += luminance(power_of(importon));
  }
  return sum / power;
}

// Clusters in the scene do not reach from the sphere to the wall behind it.
TEST(GbufferLights, ClustersInTheSceneAreSmallest) {
  const GBuffer gbuffer = test::room_gbuffer(64, 64);
  const double in_scene = mean_variance(importons_of(gbuffer, "kmeans-3d", 256));
  for (const char* generation : {"fis-2014", "fis-2016", "kmeans-2d"})
    EXPECT_LT(1.3 * in_scene, mean_variance(importons_of(gbuffer, generation, 256))) << generation;
}

// [Tokuyoshi 2016, Fig. 1] Sized by the density at their centres, kernels about dark pixels among bright ones
// are too large.
TEST(GbufferLights, EqualSharesLeaveNoKernelTooLarge) {
  GBuffer gbuffer = test::room_gbuffer(64, 64);
  for (std::size_t i = 0; i < gbuffer.pixels.size(); i += 17)
    gbuffer.pixels[i].diffuse = {0.01f, 0.01f, 0.01f};
  const auto brightest = [&](const char* generation) {
    double most = 0;
    for (const interop::Importon& importon : importons_of(gbuffer, generation, 1024))
      most = std::max(most, luminance(power_of(importon)));
    return most;
  };
  EXPECT_GT(brightest("fis-2014"), 1.5 * brightest("fis-2016"));
}

// Four pixels a cell give the importance of one pixel in their place.
TEST(Pdf, LargeImagesUseCells) {
  const Rsm rsm = test::room_rsm(16);
  const PdfParams params = params_of("brsm-vsgl");
  Report report;
  const GBuffer small = test::room_gbuffer(512, 256), large = test::room_gbuffer(1024, 512);
  const auto of_small = brsm_vsgl_values(rsm, &small, params, device(), report)[0];
  const auto of_large = brsm_vsgl_values(rsm, &large, params, device(), report)[0];
  double sum = 0, difference = 0;
  for (std::size_t i = 0; i < 256; ++i) {
    sum += of_small[i];
    difference += std::abs(of_small[i] - of_large[i]);
  }
  EXPECT_LT(difference / sum, 0.01);
}

TEST(Pdf, SkippingChangesNothing) {
  const Rsm rsm = test::room_rsm(16);
  for (const char* method : {"brsm-vpl", "brsm-vsgl"})
    for (const bool glossy : {false, true}) {
      PdfParams params = params_of(method);
      const Pdf skipped = build(rsm, test::room_gbuffer(24, 24, glossy), params);
      params.skip = false;
      const Pdf whole = build(rsm, test::room_gbuffer(24, 24, glossy), params);
      for (std::size_t i = 0; i < 256; ++i)
        EXPECT_NEAR(skipped.layers[0].pyramid[i] / whole.layers[0].pyramid[i], 1, 1e-4f) << method;
    }
}

TEST(Pdf, ACameraThatSeesNothingLeavesTheFlux) {
  const Rsm rsm = test::room_rsm(16);
  GBuffer gbuffer = test::room_gbuffer(8, 8);
  gbuffer.pixels.assign(64, test::nothing());
  for (const char* method : {"brsm-vpl", "brsm-vsgl"}) {
    Report report;
    const Pdf pdf = build_pdf(rsm, &gbuffer, params_of(method), device(), report);
    EXPECT_EQ(pdf.layers[0].pyramid, build(rsm, gbuffer, params_of("flux")).layers[0].pyramid);
    EXPECT_NE(report.to_json().at("skipped").dump().find("bidirectional"), std::string::npos);
  }
}

TEST(Pdf, NothingReflects) {
  Rsm rsm = test::room_rsm(16);
  rsm.layers[0].pyramid = test::moment_pyramid(std::vector<DoubleMoments>(256), 16);
  for (const PdfMethod& method : pdf_methods()) {
    Report report;
    const GBuffer gbuffer = test::room_gbuffer(8, 8);
    const Pdf pdf = build_pdf(rsm, &gbuffer, params_of(method.name), device(), report);
    EXPECT_EQ(mean_of(pdf), 0);
    EXPECT_FALSE(report.to_json().at("skipped").empty());
  }
}

TEST(Pdf, SameBytesTwice) {
  const Rsm rsm = test::room_rsm(64);
  const GBuffer gbuffer = test::room_gbuffer(64, 36);
  for (const PdfMethod& method : pdf_methods()) {
    const Pdf a = build(rsm, gbuffer, params_of(method.name)),
              b = build(rsm, gbuffer, params_of(method.name));
    EXPECT_EQ(a.layers[0].pyramid, b.layers[0].pyramid) << method.name;
  }
}

TEST(Pdf, RejectsWhatItCannotUse) {
  const Rsm rsm = test::room_rsm(16);
  GBuffer gbuffer = test::room_gbuffer(8, 8);
  Report report;
  const auto attempt = [&](const GBuffer* image, const std::function<void(PdfParams&)>& change) {
    return [&, image, change] {
      PdfParams params;
      change(params);
      build_pdf(rsm, image, params, device(), report);
    };
  };
  using test::expect_error;
  expect_error(ErrorCode::bad_value, {"method", "brsm-vpl"},
               attempt(&gbuffer, [](auto& p) { p.method = "brsm"; }));
  expect_error(ErrorCode::out_of_range, {"gbuffer_lights"},
               attempt(&gbuffer, [](auto& p) { p.gbuffer_lights = 0; }));
  expect_error(ErrorCode::out_of_range, {"view_samples"},
               attempt(&gbuffer, [](auto& p) { p.view_samples = 1 << 21; }));
  expect_error(ErrorCode::out_of_range, {"defensive"}, attempt(&gbuffer, [](auto& p) { p.defensive = 1.5; }));
  expect_error(ErrorCode::bad_value, {"gbuffer_generation", "kmeans-3d"},
               attempt(&gbuffer, [](auto& p) { p.gbuffer_generation = "kmeans"; }));
  expect_error(ErrorCode::missing_option, {"G-buffer"}, attempt(nullptr, [](auto&) {}));
  gbuffer.anchor = {1, 0, 0};
  expect_error(ErrorCode::invalid_data, {"anchor"}, attempt(&gbuffer, [](auto&) {}));
}

}  // namespace
}  // namespace vsgl
