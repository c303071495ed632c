// The float32 evaluation of clusters against its double-precision twin, math/fvpl.h.

#include "cluster/evaluate.h"

#include <gtest/gtest.h>

#include <random>
#include <span>

#include "../synthetic_room.h"
#include "cluster/cluster.h"
#include "math/fvpl.h"

namespace vsgl::test {
namespace {

using interop::Cluster;

std::mt19937& random_bits() {
  static std::mt19937 bits(7);
  return bits;
}
double uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_bits());
}
double log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}
Vec3 about(Vec3 centre, double spread) {
  return normalise(centre + spread * Vec3{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
}

// Above the receivers, facing down.
Lights random_light(std::uint32_t ndf, double size, double deficit) {
  interop::Light light{};
  light.position = to_float(Vec3{uniform(-1, 1), uniform(0.5, 2), uniform(-1, 1)});
  light.variance = static_cast<float>(size * size);
  light.power_diffuse = to_float(Vec3{1, 0.5, 0.2});
  light.normal = light.shading_normal = to_float(about({0, -1, 0}, 0.5));
  light.normal_deficit = static_cast<float>(deficit);
  light.incident = to_float(about(to_double(light.normal), 0.7));
  light.ndf = ndf;
  light.alpha = static_cast<float>(uniform(0.05, 0.7));
  light.lobe_variance = static_cast<float>(uniform(0, 0.05));
  light.shading_deficit = 0.5f * light.lobe_variance;
  if (ndf != interop::NDF_NONE) light.power_specular = to_float(Vec3{0.3, 0.6, 0.9});
  Lights lights;
  lights.lights = {light};
  return lights;
}

// Sixteen points on the floor around the origin, each with a lobe of its own.
GBuffer random_floor(std::uint32_t ndf) {
  GBuffer gbuffer;
  gbuffer.width = gbuffer.height = 4;
  gbuffer.camera = {0, 2, 3};
  for (int i = 0; i < kTileSamples; ++i) {
    interop::Surface s{};
    s.position = to_float(Vec3{uniform(-1, 1), 0, uniform(-1, 1)});
    s.normal = {0, 1, 0};
    s.shading_normal = to_float(about({0, 1, 0}, 0.1));
    s.diffuse = to_float(Vec3{0.5, 0.7, 0.3});
    s.alpha = static_cast<float>(uniform(0.05, 0.7));
    s.ndf = ndf;
    if (ndf != interop::NDF_NONE) s.specular = to_float(Vec3{0.2, 0.3, 0.4});
    gbuffer.pixels.push_back(s);
  }
  return gbuffer;
}

TileSamples all_pixels() {
  TileSamples samples;
  for (std::uint32_t i = 0; i < kTileSamples; ++i) samples.pixel[i] = i;
  samples.present = 0xFFFF;
  return samples;
}

struct Sample {
  const interop::Surface& surface;
  SpecularReceiver receiver;
  FvplView view;
};
Sample sample(const Cluster& c, const GBuffer& gbuffer, std::size_t pixel) {
  const interop::Surface& s = gbuffer.pixels[pixel];
  const Vec3 position = to_double(s.position);
  return {s,
          specular_receiver(s.ndf, static_cast<double>(s.alpha), to_double(s.shading_normal),
                            normalise(gbuffer.camera - position)),
          fvpl_view(to_double(c.position) - position, static_cast<double>(c.inverse_variance))};
}

bool looks_like_a_point(const Cluster& c, const Sample& s) {
  return c.normal_sharpness > interop::CLUSTER_FLAT &&
         fvpl_is_point(s.view.sharpness, s.surface.ndf == interop::NDF_NONE ? 0 : s.receiver.across);
}

// A point only where it is one from all samples.
std::array<double, kTileSamples> expected(const Cluster& c, const GBuffer& gbuffer) {
  bool point = true;
  for (std::size_t i = 0; i < kTileSamples; ++i) point &= looks_like_a_point(c, sample(c, gbuffer, i));
  std::array<double, kTileSamples> out;
  for (std::size_t i = 0; i < kTileSamples; ++i) {
    const Sample s = sample(c, gbuffer, i);
    FvplReflection reflection =
        point ? fvpl_point(s.receiver, c, s.view) : fvpl_extended(s.receiver, c, s.view);
    if (!point && s.surface.ndf != interop::NDF_NONE)  // the cheaper lobe serves for decisions
      reflection.specular = fvpl_fluence(s.view.d2, static_cast<double>(c.inverse_variance)) *
                            specular_vmf_blend(s.receiver, s.view.u, s.view.sharpness);
    const Vec3 reflectance = reflection.diffuse * to_double(s.surface.diffuse) +
                             reflection.specular * to_double(s.surface.specular);
    out[i] = luminance(fvpl_emission(c, s.view.u, s.view.inverse_d2) * reflectance);
  }
  return out;
}

struct Case {
  std::uint32_t emission, reflection;
};
class Evaluation : public testing::TestWithParam<Case> {};

// Within 0.5% of the value and 1% of the tile's brightest sample over 100: what a choice of eps >= 1e-3
// needs.
TEST_P(Evaluation, AgreesWithItsTwin) {
  for (int trial = 0; trial < 400; ++trial) {
    const double size = log_uniform(1e-3, 1), deficit = trial % 2 == 0 ? 0 : log_uniform(1e-2, 0.5);
    const Cluster c = pack_clusters(random_light(GetParam().emission, size, deficit)).front();
    const GBuffer gbuffer = random_floor(GetParam().reflection);
    ClusterLight light;
    evaluate(c, sample_receivers(gbuffer, all_pixels()), light);
    const std::array<double, kTileSamples> twin = expected(c, gbuffer);
    const double peak = *std::ranges::max_element(twin);
    for (std::size_t i = 0; i < kTileSamples; ++i) {
      const double error = std::abs(static_cast<double>(light.value[i]) - twin[i]) / (twin[i] + 0.01 * peak);
      EXPECT_LT(error, 0.005) << "trial " << trial << " sample " << i << " size " << size << " deficit "
                              << deficit << " value " << light.value[i] << " twin " << twin[i];
    }
  }
}

constexpr std::uint32_t kNdfs[] = {interop::NDF_NONE, interop::NDF_GGX, interop::NDF_BECKMANN,
                                   interop::NDF_PHONG};
std::vector<Case> cases() {
  std::vector<Case> out;
  for (const std::uint32_t emission : kNdfs)
    for (const std::uint32_t reflection : kNdfs) out.push_back({emission, reflection});
  return out;
}
INSTANTIATE_TEST_SUITE_P(Ndfs, Evaluation, testing::ValuesIn(cases()), [](const auto& test) {
  return "emission" + std::to_string(test.param.emission) + "reflection" +
         std::to_string(test.param.reflection);
});

// ---- Glints: of patches of mirror-like texels, one of which a mirror-like floor shows to the camera.

constexpr int kPatchTexels = 64;

// 8 x 8 texels of a patch of `size` in the light's plane, the first in the corner: where they lie,
interop::vec3 texel_at(const interop::Light& light, double size, int i) {
  const Vec3 n = to_double(light.normal), s = normalise(cross(n, {0, 0, 1})), t = cross(n, s);
  const double x = (i % 8 - 3.5) / 8, y = (i / 8 - 3.5) / 8;
  return to_float(to_double(light.position) + size * (x * s + y * t));
}
// and all of them, with the light's power.
std::vector<interop::Light> texels_of(const interop::Light& light, double size) {
  interop::Light texel = light;
  texel.variance = static_cast<float>(size * size / (12 * kPatchTexels));
  texel.power_specular = to_float(to_double(light.power_specular) / kPatchTexels);
  std::vector<interop::Light> out(kPatchTexels, texel);
  for (int i = 0; i < kPatchTexels; ++i) out[static_cast<std::size_t>(i)].position = texel_at(light, size, i);
  return out;
}

// Turns the source and a pixel so that light which leaves `at` is reflected to the pixel and on to the
// camera.
void let_shine(interop::Light& light, interop::Surface& pixel, Vec3 camera, Vec3 at) {
  const Vec3 away = normalise(to_double(pixel.position) - at), n = to_double(light.normal);
  light.incident = to_float(2 * dot(n, away) * n - away);
  pixel.shading_normal = to_float(normalise(normalise(camera - to_double(pixel.position)) - away));
}

interop::Light mirror_patch(double size) {
  interop::Light light = random_light(interop::NDF_GGX, size / std::sqrt(12), 0).lights.front();
  light.alpha = 0.03f;
  light.lobe_variance = light.shading_deficit = 0;
  light.shading_normal = light.normal;
  light.power_diffuse = {};
  return light;
}

// Where the texels send four times what their mean does, the glint tells.
TEST(Glint, TellsOfWhatTheMeanHides) {
  constexpr std::size_t kTrials = 400;
  std::vector<GBuffer> floors;
  Lights lights;  // of each trial the patch and its texels
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    const double size = log_uniform(0.02, 0.5);
    interop::Light light = mirror_patch(size);
    GBuffer& floor = floors.emplace_back(random_floor(interop::NDF_GGX));
    for (interop::Surface& s : floor.pixels) s.alpha = 0.03f;
    let_shine(light, floor.pixels.front(), floor.camera, to_double(texel_at(light, size, 0)));
    lights.lights.push_back(light);
    std::ranges::copy(texels_of(light, size), std::back_inserter(lights.lights));
  }
  const std::vector<Cluster> clusters = pack_clusters(lights);
  int hidden = 0, told = 0;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    const SampleReceivers receivers = sample_receivers(floors[trial], all_pixels());
    const std::span own = std::span(clusters).subspan(trial * (1 + kPatchTexels), 1 + kPatchTexels);
    ClusterLight mean, texel;
    evaluate(own.front(), receivers, mean);
    float sum = 0;
    for (const Cluster& c : own.subspan(1)) {
      evaluate(c, receivers, texel);
      sum += texel.value[0];
    }
    Lanes glint;
    evaluate_glint(own.front(), receivers, {}, 0, glint);
    for (std::size_t i = 0; i < kTileSamples; ++i) ASSERT_GE(glint[i], 0);
    if (sum < 4 * mean.value[0]) continue;
    ++hidden;
    told += glint[0] > 0.25F * sum;
  }
  EXPECT_GT(hidden, 100);
  EXPECT_GE(told, hidden * 9 / 10) << "of " << hidden;
}

// Nor does it see any where directions to the cluster stay out of the lobes: of a patch right above pixels
// that the camera sees from above.
TEST(Glint, NeedsLobesThatTheClusterReaches) {
  GBuffer floor = random_floor(interop::NDF_GGX);
  floor.camera = {0, 2, 0};
  for (interop::Surface& s : floor.pixels) {
    s.position = {};
    s.shading_normal = s.normal;
    s.alpha = 0.03f;
  }
  const SampleReceivers receivers = sample_receivers(floor, all_pixels());
  interop::Light light = mirror_patch(0.04);
  light.position = {0, 1, 0};
  light.shading_normal = light.normal = {0, -1, 0};
  const auto glint_of = [&](interop::vec3 incident, float reach) {
    light.incident = incident;
    Lights patch;
    patch.lights = {light};
    Lanes reaches, glint;
    reaches.lane.fill(reach);
    evaluate_glint(pack_clusters(patch).front(), receivers, reaches, 1, glint);
    return glint[0];
  };
  const interop::vec3 above{0, -1, 0}, aside = to_float(normalise(Vec3{1, -1, 0}));
  EXPECT_GT(glint_of(above, 0), 1000 * glint_of(aside, 0));
  EXPECT_GT(glint_of(aside, 0.5F), 10 * glint_of(aside, 0));
}

}  // namespace
}  // namespace vsgl::test
