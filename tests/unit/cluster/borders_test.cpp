// Gains that bring the cuts of neighbouring tiles together.

#include "cluster/borders.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "../synthetic_room.h"
#include "../synthetic_tree.h"
#include "cluster/cluster.h"
#include "cluster/evaluate.h"

namespace vsgl::test {
namespace {

constexpr int kWidth = 48, kHeight = 32;

// A plane of 3 x 2 tiles, a pixel every 5 cm, facing up.
GBuffer plane() {
  GBuffer out;
  out.width = kWidth;
  out.height = kHeight;
  out.camera = {0, 2, 0};
  interop::Surface s{};
  s.normal = s.shading_normal = {0, 1, 0};
  s.diffuse = {0.5f, 0.5f, 0.5f};
  s.alpha = 1;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      s.position = {0.05f * static_cast<float>(x) - 1, 0, 0.05f * static_cast<float>(y) - 1};
      out.pixels.push_back(s);
    }
  return out;
}

Cut empty_cut() {
  Cut cut;
  cut.width = kWidth;
  cut.height = kHeight;
  cut.error = 0.1;
  cut.tiles.resize(6);
  return cut;
}

// Light that varies smoothly, of which each tile makes `factor` as much.
float light(std::uint32_t pixel) {
  return 1 + 0.02f * static_cast<float>(pixel % kWidth) + 0.01f * static_cast<float>(pixel / kWidth);
}
constexpr float kFactors[] = {1, 1.05f, 0.97f, 1.03f, 1, 0.94f};

std::vector<TileRing> rings_of(const GBuffer& gbuffer, std::size_t entries) {
  std::vector<TileRing> rings(6);
  for (std::size_t tile = 0; tile < rings.size(); ++tile) {
    const TileSamples samples = ring_samples(gbuffer, static_cast<int>(tile));
    rings[tile].present = samples.present;
    rings[tile].entries = entries;
    for (std::size_t k = 0; k < kTileSamples; ++k)
      if (samples.present >> k & 1U) rings[tile].light[k] = kFactors[tile] * light(samples.pixel[k]);
  }
  return rings;
}

std::size_t tile_of(std::uint32_t pixel) {
  return pixel / kWidth / 16 * 3 + pixel % kWidth / 16;
}

// The largest step of value(pixel) / light(pixel) from one pixel to the next, across borders of tiles.
template <class Value>
double largest_step(Value value) {
  double most = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      for (const std::uint32_t next : {x % 16 == 15 && x + 1 < kWidth ? 1U : 0U, y == 15 ? 48U : 0U}) {
        const std::uint32_t pixel = y * kWidth + x;
        most = std::max(
            most, std::abs(static_cast<double>(value(pixel + next)) - static_cast<double>(value(pixel))));
      }
  return most;
}

TEST(Ring, SharesItsPixelsWithTheTilesBeside) {
  const GBuffer gbuffer = plane();
  const TileSamples first = ring_samples(gbuffer, 0), right = ring_samples(gbuffer, 1),
                    below = ring_samples(gbuffer, 3);
  EXPECT_EQ(first.present, 0xFFFFU);
  EXPECT_EQ(first.pixel[1], 4U);
  EXPECT_EQ(first.pixel[4], 16U);
  EXPECT_EQ(first.pixel[4], right.pixel[0]);
  EXPECT_EQ(first.pixel[8], 16U + 8 * kWidth);
  EXPECT_EQ(first.pixel[8], right.pixel[7]);
  EXPECT_EQ(first.pixel[11], below.pixel[0]);
  EXPECT_EQ(first.pixel[15], 16U + 16 * kWidth);
  EXPECT_EQ(below.present, 0xFFFFU);
  EXPECT_EQ(below.pixel[15], 16U + 31 * kWidth) << "the image ends";
}

TEST(Ring, KeepsToTheSurfacesOfItsTile) {
  GBuffer gbuffer = plane();
  gbuffer.pixels[8 * kWidth + 16].normal = {1, 0, 0};         // another surface begins at the border
  gbuffer.pixels[4 * kWidth + 15].id = interop::NO_INSTANCE;  // nothing here to continue
  gbuffer.pixels[16 * kWidth + 8].id = interop::NO_INSTANCE;  // nothing there
  gbuffer.pixels[0].ndf = interop::NDF_GGX;                   // a mirror
  gbuffer.pixels[0].alpha = 0.05f;
  gbuffer.pixels[0].specular = {0.5f, 0.5f, 0.5f};
  EXPECT_EQ(ring_samples(gbuffer, 0).present, 0xFFFFU & ~(1U | 1U << 6 | 1U << 8 | 1U << 13));
}

TEST(Gains, RemoveStepsBetweenTiles) {
  const GBuffer gbuffer = plane();
  Cut cut = empty_cut();
  set_gains(cut, rings_of(gbuffer, 100));
  const auto before = [](std::uint32_t pixel) { return kFactors[tile_of(pixel)]; };
  const auto after = [&](std::uint32_t pixel) { return before(pixel) * gain_at(gbuffer, cut, pixel); };
  EXPECT_GT(largest_step(before), 0.07);
  EXPECT_LT(largest_step(after), 0.01);  // the gains' own slope
  for (std::uint32_t pixel = 0; pixel < gbuffer.pixels.size(); ++pixel) {
    EXPECT_GT(after(pixel), 0.93f);
    EXPECT_LT(after(pixel), 1.06f);
  }
  EXPECT_EQ(gain_at(gbuffer, cut, 0), 1) << "no tile beside it";
}

TEST(Gains, TrustLargeCutsMore) {
  const GBuffer gbuffer = plane();
  Cut cut = empty_cut();
  std::vector<TileRing> rings = rings_of(gbuffer, 100);
  rings[0].entries = 1000;
  set_gains(cut, rings);
  EXPECT_NEAR(gain_at(gbuffer, cut, 8 * kWidth + 15), 1, 2e-3);
  EXPECT_NEAR(gain_at(gbuffer, cut, 8 * kWidth + 16), 1 / 1.05, 2e-3);
}

TEST(Gains, StayOnTheirSurface) {
  GBuffer gbuffer = plane();
  Cut cut = empty_cut();
  const std::vector<TileRing> rings = rings_of(gbuffer, 100);
  set_gains(cut, rings);
  const std::uint32_t pixel = 8 * kWidth + 17;
  EXPECT_LT(gain_at(gbuffer, cut, pixel), 0.985f);
  gbuffer.pixels[pixel].normal = {1, 0, 0};
  EXPECT_EQ(gain_at(gbuffer, cut, pixel), 1);
}

TEST(Gains, LeaveEdgesOfShadowsAlone) {
  const GBuffer gbuffer = plane();
  Cut cut = empty_cut();
  std::vector<TileRing> rings = rings_of(gbuffer, 100);
  for (float& value : rings[0].light) value *= 0.5f;
  for (float& value : rings[3].light) value = 0;
  set_gains(cut, rings);
  for (const float gain : cut.tiles[0].gain) EXPECT_EQ(gain, 1);
  for (const float gain : cut.tiles[3].gain) EXPECT_EQ(gain, 1);
  EXPECT_LT(cut.tiles[1].gain[8], 1) << "beside a third tile";
}

Lanes sum(const std::vector<interop::Cluster>& clusters, const SampleReceivers& receivers,
          const std::vector<TileCut::Entry>& entries) {
  Lanes out;
  for (const TileCut::Entry& entry : entries) {
    ClusterLight light;
    evaluate(clusters[entry.node], receivers, light);
    for (std::size_t k = 0; k < kTileSamples; ++k) out[k] += light.value[k];
  }
  return out;
}

// Light of real cuts, one of them far finer than its neighbours', relative to that of all leaves.
TEST(Gains, BringCutsTogether) {
  const Lights lights = tree_of(room_rsm(32, 2));
  const std::vector<interop::Cluster> clusters = pack_clusters(lights);
  const GBuffer gbuffer = plane();
  const TreeTraversal traversal(gbuffer, lights, clusters);
  std::vector<TileCut> tiles;
  for (int tile = 0; tile < 6; ++tile) {
    const CutCriterion criterion = traversal.criterion(tile % 2 == 0 ? 0.4 : 0.05);
    tiles.push_back(traversal.cut(tile_samples(gbuffer, tile), criterion, {}));
    tiles.back().ring = traversal.ring(tile, tiles.back(), {}, 0);
  }
  Cut cut = empty_cut();
  cut.tiles.clear();
  append(cut, tiles);
  std::vector<TileCut::Entry> leaves;
  for (std::uint32_t i = 0; i < clusters.size(); ++i)
    if (clusters[i].children == 0 && clusters[i].inverse_variance > 0) leaves.push_back({i, 1, 1});
  std::vector<float> ratio(gbuffer.pixels.size());
  for (int top = 0; top < kHeight; top += 4)
    for (int left = 0; left < kWidth; left += 4) {
      const TileSamples pixels = block_pixels(gbuffer, left, top);
      const SampleReceivers receivers = sample_receivers(gbuffer, pixels);
      const Lanes found = sum(clusters, receivers, tiles[tile_of(pixels.pixel[0])].entries),
                  all = sum(clusters, receivers, leaves);
      for (std::size_t k = 0; k < kTileSamples; ++k) ratio[pixels.pixel[k]] = found[k] / all[k];
    }
  const auto before = [&](std::uint32_t pixel) { return ratio[pixel]; };
  const auto after = [&](std::uint32_t pixel) { return ratio[pixel] * gain_at(gbuffer, cut, pixel); };
  EXPECT_GT(largest_step(before), 0.01);
  EXPECT_LT(largest_step(after), 0.5 * largest_step(before));
}

}  // namespace
}  // namespace vsgl::test
