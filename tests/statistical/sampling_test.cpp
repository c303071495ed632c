// Samples follow their density, and the lights made of them carry the light that the texels reflect.

#include <gtest/gtest.h>

#include <cmath>

#include "../unit/lights/chi_square.h"
#include "../unit/synthetic_room.h"
#include "pyramid/kernels.h"
#include "stages/lights/lights.h"
#include "stages/pdf/pdf.h"

namespace vsgl {
namespace {

using test::TestDensity;

gpu::Device& device() {
  static gpu::Device device({.compute_only = true});
  return device;
}

std::vector<int> count_samples(const TestDensity& density, std::uint32_t points, std::uint64_t seed) {
  KernelParams params;
  params.count = 200000;
  params.points = points;
  params.rule = interop::KERNEL_TEXEL;
  params.seed = seed;
  const DensityPyramid layers[] = {density.view()};
  Report report;
  std::vector<int> counts(static_cast<std::size_t>(density.size * density.size));
  for (const interop::Kernel& kernel : draw_kernels(layers, params, device(), report)) ++counts[kernel.texel];
  return counts;
}

TEST(Sampling, RandomPointsPassTheChiSquareTest) {
  for (const TestDensity& density : test::all_densities(128))
    for (std::uint64_t seed : {1, 2, 3}) {
      const test::ChiSquare test =
          test::chi_square(count_samples(density, interop::POINTS_RANDOM, seed), density);
      EXPECT_LT(std::abs(test.z), 4) << density.name;  // two-sided 6e-5
    }
}

TEST(Sampling, TheTestNoticesADensityWrongByATenth) {
  const TestDensity density = test::smooth_density(128);
  const TestDensity wrong = test::make_density(
      "wrong", 128, [&](int i, int j) { return density.view().at(0, i, j) * (i < 64 ? 1.1 : 0.9); });
  EXPECT_GT(test::chi_square(count_samples(density, interop::POINTS_RANDOM, 1), wrong).z, 4);
}

TEST(Sampling, LatticesAreStratified) {
  for (std::uint32_t points : {interop::POINTS_LATTICE, interop::POINTS_FIBONACCI})
    for (const TestDensity& density : test::all_densities(128))
      EXPECT_LT(test::chi_square(count_samples(density, points, 1), density).z, -20) << density.name;
}

// Mean over independent seeds within 4 standard errors.
TEST(Sampling, RandomVplsAreUnbiased) {
  const Rsm rsm = test::room_rsm(64, 2);
  const GBuffer gbuffer = test::room_gbuffer(64, 64);
  for (const PdfMethod& method : pdf_methods()) {
    PdfParams pdf_params;
    pdf_params.method = method.name;
    pdf_params.gbuffer_lights = 256;
    Report report;
    const Pdf pdf = build_pdf(rsm, &gbuffer, pdf_params, device(), report);
    double sum = 0, squares = 0;
    const int seeds = 32;
    for (int seed = 0; seed < seeds; ++seed) {
      LightsParams params;
      params.method = "vpl";
      params.points = "random";
      params.seed = static_cast<std::uint64_t>(seed);
      const Lights lights = generate_lights(rsm, &pdf, params, &device(), report);
      const double ratio = describe(lights, rsm, params, false).at("power").at("ratio");
      sum += ratio;
      squares += ratio * ratio;
    }
    const double mean = sum / seeds, variance = std::max(squares / seeds - mean * mean, 0.0);
    EXPECT_LE(std::abs(mean - 1), 4 * std::sqrt(variance / (seeds - 1)) + 1e-5) << method.name;
  }
}

TEST(Sampling, LightsCarryThePowerOfTheRsmForEveryDensity) {
  const Rsm rsm = test::room_rsm(128, 2);
  const GBuffer gbuffer = test::room_gbuffer(96, 54);
  for (const PdfMethod& method : pdf_methods()) {
    PdfParams pdf_params;
    pdf_params.method = method.name;
    pdf_params.gbuffer_lights = 256;
    Report report;
    const Pdf pdf = build_pdf(rsm, &gbuffer, pdf_params, device(), report);
    const auto ratio = [&](const std::string& rule) {
      LightsParams params;
      params.method = "fis-2016";
      params.power = rule;
      const Lights lights = generate_lights(rsm, &pdf, params, &device(), report);
      return describe(lights, rsm, params, false).at("power").at("ratio").get<double>();
    };
    EXPECT_NEAR(ratio("conserved"), 1, 1e-5) << method.name;
    // Equation (5) alone: exact where the density follows the power, some per cent low where it changes at
    // edges.
    EXPECT_NEAR(ratio("paper"), 1, method.needs_gbuffer ? 0.05 : 0.005) << method.name;
  }
}

}  // namespace
}  // namespace vsgl
