#include "stages/metrics/score_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vsgl::metrics {
namespace {

TEST(ScoreMap, TakesTheWorstChannelWithItsSign) {
  // Differences of 1, -3 and 2 standard errors; then the same with a variance on both sides; then none.
  const LayerPair layer{
      "indirect", 3, 1, {{1.1f, 0.7f, 1.2f}, {2, 2, 2}, {5, 5, 5}}, {{1, 1, 1}, {1, 2, 2}, {4, 4, 4}}};
  const Uncertainty exact, reference{{{0.01f, 0.01f, 0.01f}, {0.5f, 0.5f, 0.5f}, {0, 0, 0}}, std::nullopt};
  const Uncertainty test{{{0, 0, 0}, {0.5f, 0.5f, 0.5f}, {0, 0, 0}}, std::nullopt};
  const std::vector<float> map = score_map(layer, test, reference);
  EXPECT_NEAR(map[0], -3, 1e-4);
  EXPECT_NEAR(map[1], 1, 1e-4);
  EXPECT_EQ(map[2], 0);
  EXPECT_NEAR(score_map(layer, exact, reference)[1], std::sqrt(2), 1e-4);
}

TEST(ScoreMap, WhatIsNotFiniteStaysSo) {
  const LayerPair layer{"indirect", 1, 1, {{1, std::nanf(""), 1}}, {{1, 1, 1}}};
  const Uncertainty reference{{{1, 1, 1}}, std::nullopt};
  EXPECT_FALSE(std::isfinite(score_map(layer, {}, reference)[0]));
}

}  // namespace
}  // namespace vsgl::metrics
