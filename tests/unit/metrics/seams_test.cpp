// Seams against images whose steps are known.

#include "stages/metrics/seams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "stages/metrics/layer_metrics.h"

namespace vsgl::metrics {
namespace {

constexpr int kWidth = 64, kHeight = 48, kTile = 16;
using Field = std::function<double(int x, int y)>;

// test = reference (1 + error), but for the floor.
LayerPair images(const Field& reference, const Field& error) {
  LayerPair out{"indirect", kWidth, kHeight, {}, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double b = reference(x, y);
      const auto bf = static_cast<float>(b), af = static_cast<float>(b * (1 + error(x, y)));
      out.reference.push_back({bf, bf, bf});
      out.test.push_back({af, af, af});
    }
  return out;
}
double one(int, int) {
  return 1;
}
// 1% brighter from column 32 on in the middle row of tiles only.
double seam(int x, int y) {
  return x >= 32 && y / kTile == 1 ? 0.01 : 0;
}

Seams measured(const LayerPair& layer, int tile = kTile) {
  const auto found = measure_seams(layer, std::vector<char>(layer.reference.size()), tile);
  EXPECT_TRUE(found);
  return found.value_or(Seams{});
}

TEST(Seams, StepsAtBordersAreFound) {
  const Seams seams = measured(images(one, [](int x, int) { return x >= 32 ? 0.01 : 0; }));
  EXPECT_EQ(seams.borders, 3u * 3u + 2u * 4u);
  EXPECT_EQ(seams.left_out, 0u);
  EXPECT_NEAR(seams.border.max, 0.01 / 1.02, 1e-6);
  EXPECT_NEAR(seams.interior.max, 0, 1e-6);
  EXPECT_NEAR(seams.excess.max, 0.01 / 1.02, 1e-6);
  EXPECT_EQ(seams.border.median, 0);
}

TEST(Seams, TheWorstBorderHasItsPlace) {
  const Seams across = measured(images(one, seam));
  EXPECT_TRUE(across.worst_is_vertical);
  EXPECT_EQ(across.worst_x, 32);
  EXPECT_EQ(across.worst_y, 16);
  const Seams down = measured(images(one, [](int x, int y) { return y >= 32 ? 1e-4 * x : 0; }));
  EXPECT_FALSE(down.worst_is_vertical);
  EXPECT_EQ(down.worst_x, 48);
  EXPECT_EQ(down.worst_y, 32);
}

TEST(Seams, StepsInsideTilesAreNone) {
  const Seams seams = measured(images(one, [](int x, int) { return x >= 34 ? 0.01 : 0; }));
  EXPECT_NEAR(seams.border.max, 0, 1e-6);
  EXPECT_NEAR(seams.interior.max, 0.01 / 1.02, 1e-6);
  EXPECT_LE(seams.excess.max, 1e-6);
}

// An error that rises by 1% from pixel to pixel is no seam; one that rises and falls along the border
// neither.
TEST(Seams, SmoothAndAlternatingErrorsAreNone) {
  EXPECT_NEAR(measured(images(one, [](int x, int) { return 0.01 * x; })).excess.max, 0, 1e-6);
  const Seams seams =
      measured(images(one, [](int x, int y) { return x >= 32 ? (y % 2 == 0 ? 0.01 : -0.01) : 0; }));
  EXPECT_NEAR(seams.excess.max, 0, 1e-6);
}

TEST(Seams, NoiseHasNoExcessOnAverage) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 0.05);
  const Seams seams = measured(images(one, [&](int, int) { return normal(random); }));
  EXPECT_GT(seams.border.median, 0.003);
  EXPECT_NEAR(seams.excess.median, 0, 0.01);
}

// An error of 1% of the brightness changes with it: that is no step of the relative error, but for the floor.
TEST(Seams, EdgesOfThePictureAreLeftOut) {
  const Seams seams = measured(
      images([](int x, int) { return x >= 32 ? 1 : 0.01; }, [](int x, int) { return x >= 32 ? 0.1 : 0; }));
  EXPECT_EQ(seams.left_out, 3u);
  EXPECT_NEAR(seams.excess.max, 0, 1e-6);
  const Seams mild = measured(
      images([](int x, int) { return x >= 32 ? 1 : 0.95; }, [](int x, int) { return x >= 32 ? 0.1 : 0; }));
  EXPECT_EQ(mild.left_out, 0u);
  EXPECT_GT(mild.excess.max, 0.09);
}

TEST(Seams, PixelsThatAreLeftOutDoNotCount) {
  const LayerPair layer = images(one, seam);
  std::vector<char> left_out(layer.reference.size());
  for (int y = 16; y < 29; ++y) left_out[static_cast<std::size_t>(y * kWidth + 32)] = 1;
  EXPECT_EQ(measure_seams(layer, left_out, kTile)->left_out, 1u);
  left_out[28 * kWidth + 32] = 0;  // four pairs
  EXPECT_EQ(measure_seams(layer, left_out, kTile)->left_out, 0u);
  EXPECT_FALSE(measure_seams(layer, std::vector<char>(layer.reference.size(), 1), kTile));
}

TEST(Seams, AnImageOfOneTileHasNone) {
  EXPECT_FALSE(measure_seams(images(one, one), std::vector<char>(kWidth * kHeight), 64));
}

TEST(Seams, AreMeasuredWhereAskedFor) {
  LayerOptions options;
  EXPECT_FALSE(measure_layer(images(one, seam), {}, {}, options)->seams);
  options.seam_tile = kTile;
  const auto result = measure_layer(images(one, seam), {}, {}, options);
  ASSERT_TRUE(result->seams);
  EXPECT_NEAR(result->seams->excess.max, 0.01 / 1.02, 1e-6);
}

}  // namespace
}  // namespace vsgl::metrics
