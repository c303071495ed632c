#include "math/metropolis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace vsgl {
namespace {

using interop::Chain;

constexpr std::uint64_t kSeed = 0x123456789abcull;

// 2x2 texels: three with a density, and one without.
constexpr int kTop = 1;
constexpr float kDensity[4] = {0.5f, 1.0f, 2.5f, 0.0f};

std::size_t texel_of(const Chain& chain) {
  const auto [i, j] = chain_texel(chain, kTop);
  return 2 * j + i;
}

// counts[a][b]: mutations that took one long chain from texel a to texel b.
std::vector<std::vector<double>> transitions(float large_step, std::uint32_t steps) {
  std::vector<std::vector<double>> counts(4, std::vector<double>(4));
  Chain chain = chain_at(0, {0, 0}, {0.5, 0.5}, kTop);
  for (std::uint32_t step = 0; step < steps; ++step) {
    const Proposal next = chain_propose(chain, 7, step, kSeed, large_step, 1, kTop);
    const std::size_t from = texel_of(chain), to = texel_of(next.chain);
    const bool accepted = chain_accepts(kDensity[from], kDensity[to], next.threshold);
    ++counts[from][accepted ? to : from];
    if (accepted) chain = next.chain;
  }
  return counts;
}

// As often there as back, within 4 standard deviations, and each texel as often as its density says.
TEST(Metropolis, DetailedBalanceOnThreeTexels) {
  const double steps = 200000;
  for (const float large_step : {1.0f, 0.3f, 0.0f}) {
    const auto counts = transitions(large_step, static_cast<std::uint32_t>(steps));
    for (std::size_t a = 0; a < 4; ++a) {
      double visits = 0;
      for (std::size_t b = 0; b < 4; ++b) {
        visits += counts[a][b];
        EXPECT_LE(std::abs(counts[a][b] - counts[b][a]), 4 * std::sqrt(counts[a][b] + counts[b][a]) + 1);
        if (a != b && a != 3 && b != 3) {
          EXPECT_GT(counts[a][b], 1000);
        }
      }
      EXPECT_NEAR(visits / steps, static_cast<double>(kDensity[a]) / 4, 0.01) << a;
    }
  }
}

TEST(Metropolis, AcceptsByTheRatioOfDensities) {
  EXPECT_TRUE(chain_accepts(1, 2, 0.999f));
  EXPECT_TRUE(chain_accepts(2, 1, 0.499f));
  EXPECT_FALSE(chain_accepts(2, 1, 0.5f));
  EXPECT_FALSE(chain_accepts(1, 0, 0));
  EXPECT_TRUE(chain_accepts(0, 0, 0.9f));  // from nowhere it goes anywhere
  EXPECT_TRUE(chain_accepts(0, 1, 0.9f));
}

// Mean and variance of 16 texels' uniform distribution, the torus included.
TEST(Metropolis, SmallStepsStayWithinEightTexels) {
  const int top = 7;  // 128 texels
  const Chain edge{5, 0x80000000u, 3};
  double sum = 0, squares = 0;
  const std::uint32_t steps = 20000;
  for (std::uint32_t step = 0; step < steps; ++step) {
    const Chain next = chain_propose(edge, 0, step, kSeed, 0, 6, top).chain;
    EXPECT_EQ(next.layer, 3u);
    const double texels = static_cast<std::int32_t>(next.x - edge.x) * std::ldexp(1.0, top - 32);
    EXPECT_LE(std::abs(texels), 8);
    EXPECT_LE(std::abs(static_cast<std::int32_t>(next.y - edge.y) * std::ldexp(1.0, top - 32)), 8);
    sum += texels;
    squares += texels * texels;
  }
  EXPECT_NEAR(sum / steps, 0, 4 * 8 / std::sqrt(3.0 * steps));
  EXPECT_NEAR(squares / steps, 64.0 / 3, 0.5);
}

TEST(Metropolis, LargeStepsGoAnywhereInAnyLayer) {
  std::vector<double> layers(6), quarters(4);
  const std::uint32_t steps = 24000;
  for (std::uint32_t step = 0; step < steps; ++step) {
    const Chain next = chain_propose({1, 2, 3}, 9, step, kSeed, 1, 6, 10).chain;
    ++layers.at(next.layer);
    ++quarters[next.x >> 31 | (next.y >> 31) << 1];
  }
  for (const double n : layers) EXPECT_NEAR(n, steps / 6.0, 4 * std::sqrt(steps / 6.0));
  for (const double n : quarters) EXPECT_NEAR(n, steps / 4.0, 4 * std::sqrt(steps / 4.0));
}

TEST(Metropolis, KnowsItsTexel) {
  for (const int top : {0, 1, 8, 12})
    for (const std::uint32_t texel : {0u, (1u << top) / 3, (1u << top) - 1}) {
      const Chain chain = chain_at(2, {texel, 0}, {0.75, 0.125}, top);
      EXPECT_EQ(chain_texel(chain, top)[0], texel) << top;
      EXPECT_EQ(chain_texel(chain, top)[1], 0u);
      EXPECT_EQ(chain_point(chain, top)[0], 0.75);
      EXPECT_EQ(chain_point(chain, top)[1], 0.125);
      EXPECT_EQ(chain.layer, 2u);
    }
}

}  // namespace
}  // namespace vsgl
