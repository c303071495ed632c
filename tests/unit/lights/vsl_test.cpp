// Virtual spherical lights, and the passes of progressive rendering.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "../expect_error.h"
#include "../synthetic_room.h"
#include "math/progressive.h"
#include "stages/lights/lights.h"

namespace vsgl {
namespace {

using interop::Light;

const Rsm& room() {
  static const Rsm rsm = test::room_rsm(64);
  return rsm;
}

std::vector<Light> generate(const LightsParams& params) {
  static gpu::Device device({.compute_only = true});
  static const Pdf pdf = test::flux_pdf(room());
  Report report;
  return generate_lights(room(), &pdf, params, &device, report).lights;
}

double radius_of(const Light& light) {
  return 2 * std::sqrt(static_cast<double>(light.variance));
}

double distance_to_neighbour(const std::vector<Light>& lights, std::size_t self, std::size_t k) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (i != self)
      distances.push_back(length(test::to_double(lights[i].origin) - test::to_double(lights[self].origin)));
  std::sort(distances.begin(), distances.end());
  return distances[k - 1];
}

bool same_bytes(const std::vector<Light>& a, const std::vector<Light>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Light)) == 0;
}

TEST(VslLights, ReachToTheirKthNearest) {
  for (const int k : {1, 10}) {
    const auto lights =
        generate({.method = "vsl", .count = 256, .vsl_neighbours = k, .vsl_radius_scale = 0.5});
    const auto texels = generate({.method = "fis-2016", .count = 256, .kernel_scale = 1e-9});
    ASSERT_EQ(lights.size(), texels.size());
    std::size_t reaching = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const double wanted = 0.5 * distance_to_neighbour(lights, i, static_cast<std::size_t>(k));
      const double largest = 0.1 * room().scene_radius;
      if (wanted > radius_of(texels[i]) && wanted < largest) {  // neither bound by its texel nor by the scene
        EXPECT_NEAR(radius_of(lights[i]) / wanted, 1, 1e-5);
        ++reaching;
      }
      EXPECT_LE(radius_of(lights[i]), largest * (1 + 1e-6));
      EXPECT_GE(radius_of(lights[i]), std::min(wanted, largest) * (1 - 1e-6));
    }
    EXPECT_GT(reaching, 64u) << k;
  }
}

TEST(VslLights, HaveTheFootprintOfTheirTexelAtLeast) {
  const auto lights = generate({.method = "vsl", .count = 64, .vsl_radius_scale = 1e-9});
  for (const Light& light : lights) {
    const interop::Moments& moments = room().layers[light.layer].pyramid[light.texel];
    const double variance = std::max(0.5 * static_cast<double>(moments.spread), 1e-12);
    EXPECT_NEAR(static_cast<double>(light.variance) / variance, 1, 1e-4);
  }
}

TEST(VslLights, AreVplsButForTheirSize) {
  auto lights = generate({.method = "vsl", .count = 256});
  for (Light& light : lights) light.variance = 0;
  EXPECT_TRUE(same_bytes(lights, generate({.method = "vpl", .count = 256})));
}

TEST(VslLights, TheOnlyLightIsAsLargeAsAllowed) {
  const auto lights = generate({.method = "vsl", .count = 1});
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_NEAR(radius_of(lights[0]), 0.1 * room().scene_radius, 1e-5);
}

TEST(Passes, ShrinkByTheRecurrence) {
  double scale = 1;
  for (int i = 1; i < 200; ++i) {
    EXPECT_NEAR(radius2_scale({.number = i}), scale, 1e-12);
    scale *= (i + 2.0 / 3) / (i + 1);
  }
  // Variance and squared bias of the mean over n passes: both fall as n^(-2/3) in the end.
  double variance = 0, bias = 0;
  std::vector<double> variances, squared_biases;
  for (int i = 1; i <= 4096; ++i) {
    variance += 1 / radius2_scale({.number = i});
    bias += radius2_scale({.number = i});
    variances.push_back(variance / i / i);
    squared_biases.push_back(bias * bias / i / i);
  }
  EXPECT_NEAR(std::log2(variances[4095] / variances[2047]), -2.0 / 3, 0.01);
  EXPECT_NEAR(std::log2(squared_biases[4095] / squared_biases[2047]), -2.0 / 3, 0.02);
}

TEST(Passes, TheFirstIsWhatIsMadeWithoutPasses) {
  for (const char* method : {"vpl", "vsl", "fis-2014", "fis-2016"}) {
    SCOPED_TRACE(method);
    const auto without = generate({.method = method, .count = 64});
    EXPECT_TRUE(same_bytes(without, generate({.method = method, .count = 64, .pass = {1, 0.3}})));
    const auto second = generate({.method = method, .count = 64, .pass = {2}});
    EXPECT_FALSE(same_bytes(without, second));
    EXPECT_TRUE(same_bytes(second, generate({.method = method, .count = 64, .pass = {2}})));
  }
}

double mean_variance(const LightsParams& params) {
  double sum = 0;
  const auto lights = generate(params);
  for (const Light& light : lights) sum += static_cast<double>(light.variance);
  return sum / static_cast<double>(lights.size());
}

// Whether the kernels of the first pass are larger than a texel or not.
TEST(Passes, ShrinkLights) {
  constexpr int kPass = 1000;
  const double scale = radius2_scale({.number = kPass});
  ASSERT_NEAR(scale, 0.11, 0.02);
  for (const char* method : {"vsl", "fis-2014", "fis-2016"})
    for (const int count : {64, 4096}) {
      const LightsParams first{.method = method, .count = count};
      LightsParams late = first;
      late.pass.number = kPass;
      // Wider kernels reach across the edges of objects: they shrink by more, those near a texel by less.
      const double ratio = mean_variance(late) / mean_variance(first);
      EXPECT_GT(ratio, 0.3 * scale) << method << " " << count;
      EXPECT_LT(ratio, 3 * scale) << method << " " << count;
    }
}

TEST(Passes, AreForMethodsThatSample) {
  test::expect_error(ErrorCode::bad_value, {"pass", "tree", "fis-2016"},
                     [] { generate({.method = "tree", .pass = {2}}); });
  test::expect_error(ErrorCode::out_of_range, {"pass"}, [] { generate({.method = "vpl", .pass = {0}}); });
  test::expect_error(ErrorCode::out_of_range, {"pass_alpha"}, [] {
    generate({.method = "vpl", .pass = {2, 1.5}});
  });
  test::expect_error(ErrorCode::out_of_range, {"vsl_neighbours"},
                     [] { generate({.method = "vsl", .vsl_neighbours = 0}); });
  test::expect_error(ErrorCode::out_of_range, {"vsl_radius_scale"},
                     [] { generate({.method = "vsl", .vsl_radius_scale = -1}); });
}

}  // namespace
}  // namespace vsgl
