// Chains follow their density, on the device.

#include "math/metropolis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../unit/lights/chi_square.h"
#include "../unit/lights/densities.h"
#include "pyramid/kernels.h"

namespace vsgl {
namespace {

using test::TestDensity;

gpu::Device& device() {
  static gpu::Device device({.compute_only = true});
  return device;
}

KernelParams kernels(std::uint32_t count) {
  KernelParams params;
  params.count = count;
  params.points = interop::POINTS_RANDOM;
  params.rule = interop::KERNEL_TEXEL;
  params.seed = 0x5eed00000001ull;
  return params;
}

Walk walk(const TestDensity& density, std::uint32_t count, const WalkParams& params) {
  const DensityPyramid layers[] = {density.view()};
  Report report;
  return walk_chains(layers, kernels(count), params, device(), report);
}

std::vector<int> counts(const Walk& walk, const TestDensity& density) {
  std::vector<int> out(density.view().texels.size());
  out.resize(static_cast<std::size_t>(density.size * density.size));
  for (const interop::Kernel& kernel : walk.kernels) ++out[kernel.texel];
  return out;
}

constexpr std::uint32_t kChains = 50000;

// Chains are independent of one another, so that those of one moment make a sample.
TEST(Metropolis, StationaryInTheDensity) {
  for (const TestDensity& density : {test::smooth_density(64), test::caustic_density(64)})
    for (const double large_step : {1.0, 0.3}) {
      const Walk end = walk(density, kChains, {.mutations = 40, .large_step = large_step});
      EXPECT_LT(std::abs(test::chi_square(counts(end, density), density).z), 4) << density.name;
      EXPECT_GT(end.accepted, kChains / 2);
      EXPECT_LT(end.accepted, 40ull * kChains);
    }
}

// From one texel of another density they find there within some mutations; at first they are not there.
TEST(Metropolis, FindsTheDensityFromElsewhere) {
  const TestDensity density = test::smooth_density(64);
  const std::vector<interop::Chain> start(kChains, chain_at(0, {60, 3}, {0.5, 0.5}, 6));
  const auto z = [&](std::uint32_t mutations) {
    const Walk end = walk(density, kChains, {.start = start, .mutations = mutations});
    return test::chi_square(counts(end, density), density).z;
  };
  EXPECT_GT(z(1), 100);
  EXPECT_LT(std::abs(z(60)), 4);
}

TEST(Metropolis, AcceptsEverythingOfAConstantDensity) {
  const TestDensity flat = test::make_density("flat", 32, [](int, int) { return 1.0; });
  EXPECT_EQ(walk(flat, 1000, {.mutations = 10, .large_step = 0.5}).accepted, 10000u);
}

// In two parts as in one: only the number of a mutation counts.
TEST(Metropolis, GoesOnWhereItWas) {
  const TestDensity density = test::noisy_density(32);
  const Walk once = walk(density, 500, {.mutations = 30, .large_step = 0.5});
  const Walk half = walk(density, 500, {.mutations = 10, .large_step = 0.5});
  const Walk rest =
      walk(density, 500, {.start = half.chains, .first_step = 10, .mutations = 20, .large_step = 0.5});
  EXPECT_EQ(half.accepted + rest.accepted, once.accepted);
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_EQ(once.chains[i].x, rest.chains[i].x);
    EXPECT_EQ(once.chains[i].y, rest.chains[i].y);
  }
}

// The device walks as the twin does, bit by bit, over two layers.
TEST(Metropolis, WalksLikeTheTwin) {
  const TestDensity smooth = test::smooth_density(64), sparse = test::sparse_density(64);
  const std::vector<DensityPyramid> layers = {smooth.view(), sparse.view()};
  const std::uint32_t count = 2000, mutations = 25;
  const std::vector<interop::Chain> start(count, chain_at(1, {7, 7}, {0.25, 0.5}, 6));
  const WalkParams params{.start = start, .first_step = 3, .mutations = mutations, .large_step = 0.6};
  Report report;
  const KernelParams kernel_params = kernels(count);
  const Walk there = walk_chains(layers, kernel_params, params, device(), report);
  const auto density = [&](const interop::Chain& chain) {
    const auto [i, j] = chain_texel(chain, 6);
    return static_cast<float>(layers[chain.layer].at(0, static_cast<int>(i), static_cast<int>(j)));
  };
  std::uint64_t accepted = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    interop::Chain chain = start[i];
    for (std::uint32_t m = 0; m < mutations; ++m) {
      const Proposal next = chain_propose(chain, i, 3 + m, kernel_params.seed, 0.6f, 2, 6);
      if (!chain_accepts(density(chain), density(next.chain), next.threshold)) continue;
      chain = next.chain;
      ++accepted;
    }
    ASSERT_EQ(chain.x, there.chains[i].x) << i;
    ASSERT_EQ(chain.y, there.chains[i].y);
    ASSERT_EQ(chain.layer, there.chains[i].layer);
    EXPECT_EQ(there.kernels[i].power_scale > 0, density(chain) > 0);
  }
  EXPECT_EQ(accepted, there.accepted);
}

}  // namespace
}  // namespace vsgl
