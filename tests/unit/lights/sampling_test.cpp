#include "math/sampling.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "densities.h"
#include "pyramid/kernels.h"

namespace vsgl {
namespace {

using interop::POINTS_FIBONACCI;
using interop::POINTS_LATTICE;
using interop::POINTS_RANDOM;
using test::TestDensity;

constexpr std::uint32_t all_kinds[] = {POINTS_LATTICE, POINTS_FIBONACCI, POINTS_RANDOM};

TEST(PointSet, SearchedGeneratorsAreTheBest) {
  EXPECT_EQ(lattice_generator(1024), 37u);
  EXPECT_EQ(lattice_generator(2048), 167u);
  EXPECT_EQ(lattice_generator(4096), 441u);
}

TEST(PointSet, ShortestVectorAgreesWithExhaustiveSearch) {
  for (std::uint32_t n : {8u, 64u, 97u, 120u})
    for (std::uint32_t g = 1; g < n; ++g) {
      std::int64_t best = static_cast<std::int64_t>(n) * n;  // the vectors along the axes
      for (std::int64_t i = 1; i < n; ++i) {
        const std::int64_t x = std::min<std::int64_t>(i, n - i), y = i * g % n;
        best = std::min(best, x * x + std::min<std::int64_t>(y, n - y) * std::min<std::int64_t>(y, n - y));
      }
      ASSERT_EQ(lattice_shortest_squared(n, g), static_cast<std::uint64_t>(best)) << n << " " << g;
    }
}

TEST(PointSet, LatticesAreWellSpreadForAnyCount) {
  for (std::uint32_t n : {64u, 100u, 997u, 1000u, 65536u, 1000003u}) {
    const double distance =
        std::sqrt(static_cast<double>(lattice_shortest_squared(n, lattice_generator(n))) / n);
    EXPECT_GT(distance, 0.8) << n;  // the hexagonal lattice has 1.07
  }
}

TEST(PointSet, AMillionPointsDiffer) {
  for (std::uint32_t kind : {POINTS_LATTICE, POINTS_FIBONACCI}) {
    const auto set = make_point_set(kind, interop::MAX_POINTS, 1);
    std::vector<std::uint32_t> u, v;
    for (std::uint32_t i = 0; i < set.count; ++i) {
      u.push_back(point_bits(set, i)[0] >> 8);
      v.push_back(point_bits(set, i)[1] >> 8);
    }
    for (auto* values : {&u, &v}) {
      std::sort(values->begin(), values->end());
      EXPECT_EQ(std::unique(values->begin(), values->end()), values->end()) << kind;
    }
  }
}

TEST(PointSet, SeedsRotateOrReplaceThePoints) {
  for (std::uint32_t kind : all_kinds) {
    const auto a = make_point_set(kind, 64, 1), b = make_point_set(kind, 64, 1ull << 40);
    EXPECT_NE(point_bits(a, 3), point_bits(b, 3)) << kind;
    if (kind == POINTS_RANDOM) continue;
    const std::uint32_t shift = point_bits(a, 0)[0] - point_bits(b, 0)[0];
    for (std::uint32_t i = 0; i < 64; ++i) EXPECT_EQ(point_bits(a, i)[0] - point_bits(b, i)[0], shift);
  }
}

TEST(PointSet, RejectsCountsOutOfRange) {
  EXPECT_ANY_THROW(make_point_set(POINTS_LATTICE, 0, 0));
  EXPECT_ANY_THROW(make_point_set(POINTS_LATTICE, interop::MAX_POINTS + 1, 0));
  EXPECT_ANY_THROW(point_set_kind("halton"));
}

TEST(Warp, AConstantDensityLeavesPointsWhereTheyAre) {
  const TestDensity constant = test::make_density("constant", 256, [](int, int) { return 1.0; });
  const DensityPyramid layers[] = {constant.view()};
  const auto set = make_point_set(POINTS_LATTICE, 1000, 5);
  for (std::uint32_t i = 0; i < set.count; ++i) {
    const WarpedPoint warped = warp(layers, point(set, i));
    EXPECT_NEAR(warped.x, point(set, i)[0], 1e-6);
    EXPECT_NEAR(warped.y, point(set, i)[1], 1e-6);
  }
}

TEST(Warp, CornersStayInside) {
  const TestDensity density = test::sparse_density(64);
  const DensityPyramid layers[] = {density.view()};
  const double last = 1 - 0x1p-24;
  for (double u : {0.0, last})
    for (double v : {0.0, last}) {
      const WarpedPoint warped = warp(layers, {u, v});
      EXPECT_GT(density.view().at(0, warped.i, warped.j), 0);
      EXPECT_TRUE(warped.x >= 0 && warped.x < 1 && warped.y >= 0 && warped.y < 1);
    }
}

TEST(Warp, ASingleTexelHoldsAllPointsStillStratified) {
  const TestDensity density =
      test::make_density("texel", 64, [](int i, int j) { return i == 11 && j == 50 ? 1.0 : 0.0; });
  const DensityPyramid layers[] = {density.view()};
  const auto set = make_point_set(POINTS_LATTICE, 256, 0);
  std::set<int> rows;
  for (std::uint32_t i = 0; i < set.count; ++i) {
    const WarpedPoint warped = warp(layers, point(set, i));
    ASSERT_EQ(warped.i, 11);
    ASSERT_EQ(warped.j, 50);
    rows.insert(static_cast<int>((warped.y * 64 - 50) * 256));
  }
  EXPECT_GE(rows.size(), 250u);
}

TEST(Warp, LayersAreChosenByTheirMeans) {
  const TestDensity a = test::smooth_density(16), b = test::sparse_density(16);
  std::vector<float> empty(a.pyramid.size()), heavy = b.pyramid;
  for (float& p : heavy) p *= 3;
  const DensityPyramid layers[] = {{16, empty}, {16, a.pyramid}, {16, empty}, {16, heavy}, {16, empty}};
  const auto set = make_point_set(POINTS_LATTICE, 1024, 3);
  std::vector<int> counts(5);
  for (std::uint32_t i = 0; i < set.count; ++i)
    ++counts[static_cast<std::size_t>(warp(layers, point(set, i)).layer)];
  EXPECT_NEAR(counts[1], 256, 2);
  EXPECT_NEAR(counts[3], 768, 2);
}

// --- the device's functions against their twins ---

struct DrawnPoints {
  std::vector<interop::Kernel> kernels;
  std::vector<WarpedPoint> twins;
};

DrawnPoints draw(const std::vector<DensityPyramid>& layers, std::uint32_t kind, std::uint32_t count) {
  static gpu::Device device({.compute_only = true});
  Report report;
  KernelParams params;
  params.count = count;
  params.points = kind;
  params.seed = 11;
  DrawnPoints drawn{draw_kernels(layers, params, device, report), {}};
  const auto set = make_point_set(kind, count, params.seed);
  for (std::uint32_t i = 0; i < count; ++i) drawn.twins.push_back(warp(layers, point(set, i)));
  return drawn;
}

TEST(WarpOnDevice, AgreesWithItsTwin) {
  for (const TestDensity& density : test::all_densities(256))
    for (std::uint32_t kind : all_kinds) {
      const DrawnPoints drawn = draw({density.view()}, kind, 20000);
      int elsewhere = 0;
      for (std::size_t i = 0; i < drawn.kernels.size(); ++i) {
        const WarpedPoint& twin = drawn.twins[i];
        const interop::Kernel& kernel = drawn.kernels[i];
        ASSERT_GT(density.pyramid[kernel.texel], 0.0f) << density.name << ": an impossible texel";
        if (kernel.texel != static_cast<std::uint32_t>(twin.j * 256 + twin.i)) {
          ++elsewhere;
          continue;
        }
        ASSERT_NEAR(kernel.centre.x, twin.x, 1.0 / 256);
        ASSERT_NEAR(kernel.centre.y, twin.y, 1.0 / 256);
      }
      EXPECT_LE(elsewhere, 4) << density.name << " " << kind;
    }
}

TEST(WarpOnDevice, AConstantDensityShowsThePointsThemselves) {
  const TestDensity constant = test::make_density("constant", 256, [](int, int) { return 1.0; });
  for (std::uint32_t kind : all_kinds)
    for (std::uint32_t count : {1u, 7u, 8u, 1000u, 5000u}) {
      const auto set = make_point_set(kind, count, 11);
      const DrawnPoints drawn = draw({constant.view()}, kind, count);
      for (std::uint32_t i = 0; i < count; ++i) {
        ASSERT_NEAR(drawn.kernels[i].centre.x, point(set, i)[0], 1e-6);
        ASSERT_NEAR(drawn.kernels[i].centre.y, point(set, i)[1], 1e-6);
      }
    }
}

TEST(WarpOnDevice, CountsFollowTheDensity) {
  const TestDensity density = test::noisy_density(256);
  for (std::uint32_t kind : {POINTS_LATTICE, POINTS_FIBONACCI}) {
    const DrawnPoints drawn = draw({density.view()}, kind, interop::MAX_POINTS);
    std::vector<int> counts(256 * 256);
    for (const interop::Kernel& kernel : drawn.kernels) ++counts[kernel.texel];
    double worst = 0;
    for (std::size_t k = 0; k < counts.size(); ++k)
      worst = std::max(worst,
                       std::abs(counts[k] - interop::MAX_POINTS * double(density.pyramid[k]) / (256 * 256)));
    EXPECT_LE(worst, 4) << kind;
  }
}

TEST(WarpOnDevice, LayersAgreeWithTheTwin) {
  const TestDensity a = test::smooth_density(32), b = test::noisy_density(32);
  std::vector<float> empty(a.pyramid.size());
  const DrawnPoints drawn = draw({{32, empty}, a.view(), {32, empty}, b.view()}, POINTS_LATTICE, 4096);
  int elsewhere = 0;
  for (std::size_t i = 0; i < drawn.kernels.size(); ++i)
    elsewhere += drawn.kernels[i].layer != static_cast<std::uint32_t>(drawn.twins[i].layer);
  EXPECT_LE(elsewhere, 1);
}

}  // namespace
}  // namespace vsgl
