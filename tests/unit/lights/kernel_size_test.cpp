#include "math/kernel_size.h"

#include <gtest/gtest.h>

#include "densities.h"
#include "pyramid/kernels.h"

namespace vsgl {
namespace {

using test::TestDensity;

constexpr int size = 256;
constexpr double texels = double{size} * size;

double held(const DensityPyramid& density, double level, double x, double y) {
  return std::exp2(2 * level) / texels * density_trilinear(density, level, x, y);
}

// How often 4^l p(l) / M crosses the share on a fine grid of levels.
int crossings(const DensityPyramid& density, double x, double y, double share) {
  int count = 0;
  bool below = held(density, 0, x, y) < share;
  for (int k = 1; k <= 64 * density.top(); ++k) {
    const bool now = held(density, k / 64.0, x, y) < share;
    count += now != below;
    below = now;
  }
  return count;
}

TEST(KernelSize, SolvesTheIntegralEquation) {
  for (const TestDensity& density : test::all_densities(size)) {
    const DensityPyramid layers[] = {density.view()};
    for (const double share : {1.0 / 1024, 4.0 / 1024, 1.0 / 65536}) {
      const auto set = make_point_set(interop::POINTS_LATTICE, 500, 3);
      for (std::uint32_t i = 0; i < set.count; ++i) {
        const WarpedPoint at = warp(layers, point(set, i));
        const double level = kernel_level_newton(layers[0], at.x, at.y, texels, share);
        if (level == 0) {
          EXPECT_GE(held(layers[0], 0, at.x, at.y), share);
        } else {
          EXPECT_NEAR(held(layers[0], level, at.x, at.y) / share, 1, 3e-5) << density.name;
        }
        if (crossings(layers[0], at.x, at.y, share) != 1) continue;
        EXPECT_NEAR(level, kernel_level_bisection(layers[0], at.x, at.y, texels, share, 45), 1e-3)
            << density.name;
      }
    }
  }
}

TEST(KernelSize, TwelveBisectionsErrByAThousandthOfALevel) {
  const TestDensity density = test::smooth_density(size);
  for (int i = 0; i < 100; ++i) {
    const double x = 0.005 + i / 100.0, y = 0.37;
    EXPECT_NEAR(kernel_level_bisection(density.view(), x, y, texels, 1e-3, 12),
                kernel_level_bisection(density.view(), x, y, texels, 1e-3, 45), 8.0 / 8192 * 1.01);
  }
}

TEST(KernelSize, EndsOfTheRange) {
  const TestDensity density = test::smooth_density(size);
  EXPECT_EQ(kernel_level_newton(density.view(), 0.5, 0.5, texels, 1e-9), 0);
  EXPECT_EQ(kernel_level_newton(density.view(), 0.5, 0.5, texels, 2), density.view().top());
  EXPECT_EQ(kernel_level_density(1, 8, texels, 4 / texels), 1);
  EXPECT_EQ(kernel_level_density(1e6, 8, texels, 1 / texels), 0);
  EXPECT_EQ(kernel_level_density(1e-30, 8, texels, 1), 8);
}

TEST(KernelSizeOnDevice, AgreesWithItsTwin) {
  gpu::Device device({.compute_only = true});
  Report report;
  for (const TestDensity& density : test::all_densities(size)) {
    const DensityPyramid layers[] = {density.view()};
    for (std::uint32_t rule : {interop::KERNEL_DENSITY, interop::KERNEL_NEWTON, interop::KERNEL_BISECTION}) {
      KernelParams params;
      params.rule = rule;
      params.scale = 2;
      int differ = 0;
      for (const interop::Kernel& kernel : draw_kernels(layers, params, device, report)) {
        const double x = kernel.centre.x, y = kernel.centre.y, share = 2.0 / 1024;
        const double p = density.pyramid[kernel.texel];
        const double level =
            rule == interop::KERNEL_DENSITY  ? kernel_level_density(p, layers[0].top(), texels, share)
            : rule == interop::KERNEL_NEWTON ? kernel_level_newton(layers[0], x, y, texels, share)
                                             : kernel_level_bisection(layers[0], x, y, texels, share, 12);
        differ += std::abs(level - double(kernel.level)) > 1e-3;
        const double filtered = density_trilinear(layers[0], kernel.level, x, y);
        const double scale =
            texels / (rule == interop::KERNEL_DENSITY ? std::max(1024 * p, 1.0) : 1024 * filtered);
        EXPECT_NEAR(double(kernel.power_scale) / scale, 1, 1e-4) << density.name << " " << rule;
      }
      EXPECT_LE(differ, 2) << density.name << " " << rule;  // bisection may take another root
    }
  }
}

// [Tokuyoshi 2016, Eq. (5)] the powers of all kernels add up to the total where power over density varies
// little within a kernel: of the density itself, and of the density times a ramp of 1 : 8 over the image.
TEST(KernelSizeOnDevice, PowersAddUp) {
  gpu::Device device({.compute_only = true});
  Report report;
  for (const TestDensity& density : test::all_densities(size)) {
    const DensityPyramid layers[] = {density.view()};
    const TestDensity power = test::make_density("power", size, [&](int i, int j) {
      return density.view().at(0, i, j) * std::exp2(1.5 * (i + j) / size);
    });
    for (const double scale : {1.0, 4.0}) {
      KernelParams params;
      params.scale = scale;
      double of_density = 0, of_power = 0;
      for (const interop::Kernel& k : draw_kernels(layers, params, device, report)) {
        const double texels_of_light = k.power_scale, x = k.centre.x, y = k.centre.y;
        of_density += texels_of_light * density_trilinear(density.view(), k.level, x, y);
        of_power += texels_of_light * density_trilinear(power.view(), k.level, x, y);
      }
      EXPECT_NEAR(of_density / texels, 1, 1e-4) << density.name;
      EXPECT_NEAR(of_power / texels, 1, 0.01) << density.name << ", K = " << scale;
    }
  }
}

}  // namespace
}  // namespace vsgl
