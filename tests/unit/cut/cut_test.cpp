#include "stages/cut/cut.h"

#include <gtest/gtest.h>
#include <omp.h>

#include "../expect_error.h"
#include "../synthetic_room.h"
#include "../synthetic_tree.h"
#include "cluster/cluster.h"
#include "cluster/traverse.h"

namespace vsgl::test {
namespace {

const Lights& lights() {
  static const Lights instance = tree_of(room_rsm(32, 2));
  return instance;
}

// 5 x 3 tiles, the second of them background.
GBuffer gbuffer() {
  GBuffer out = room_gbuffer(72, 40);
  for (std::size_t y = 0; y < 16; ++y)
    for (std::size_t x = 16; x < 32; ++x) out.pixels[y * 72 + x] = nothing();
  return out;
}

Cut cut_with(int threads, Report& report, double error = 0.05) {
  omp_set_num_threads(threads);
  return build_cut(gbuffer(), lights(), {.error = error}, report);
}

TEST(BuildCut, JoinsTheTilesOfTheTraversal) {
  Report report;
  const Cut cut = cut_with(2, report);
  EXPECT_EQ(cut.width, 72);
  EXPECT_EQ(cut.height, 40);
  EXPECT_EQ(cut.lights, static_cast<int>(lights().lights.size()));
  EXPECT_EQ(cut.error, 0.05);
  EXPECT_FALSE(cut.has_visibility());
  ASSERT_EQ(cut.tiles.size(), 15U);
  const GBuffer image = gbuffer();
  const std::vector<interop::Cluster> clusters = pack_clusters(lights());
  const TreeTraversal traversal(image, lights(), clusters);
  std::size_t next = 0;
  for (int tile = 0; tile < 15; ++tile) {
    const TileCut expected = traversal.cut(tile_samples(image, tile), traversal.criterion(0.05), {});
    const Cut::Tile& found = cut.tiles[static_cast<std::size_t>(tile)];
    ASSERT_EQ(found.first, next);
    ASSERT_EQ(found.count, expected.entries.size());
    EXPECT_EQ(found.error, static_cast<float>(expected.error));
    for (const TileCut::Entry& entry : expected.entries) EXPECT_EQ(cut.nodes[next++], entry.node);
  }
  EXPECT_EQ(next, cut.nodes.size());
  EXPECT_EQ(cut.tiles[1].count, 0U);
}

TEST(BuildCut, IsTheSameOnAnyNumberOfThreads) {
  Report report;
  const Cut one = cut_with(1, report), two = cut_with(2, report), five = cut_with(5, report);
  EXPECT_EQ(one.nodes, two.nodes);
  EXPECT_EQ(one.nodes, five.nodes);
}

TEST(BuildCut, ReportsWhatItDid) {
  Report report;
  const Cut cut = cut_with(2, report);
  const auto json = report.to_json();
  std::vector<double> sizes;
  for (const Cut::Tile& tile : cut.tiles)
    if (tile.count > 0) sizes.push_back(tile.count);
  std::ranges::sort(sizes);
  const auto& size = json["counts"]["cut_size"];
  EXPECT_NEAR(size["mean"].get<double>(), static_cast<double>(cut.nodes.size()) / 14, 1e-9);
  EXPECT_EQ(size["median"].get<double>(), sizes[7]);
  EXPECT_EQ(size["largest"].get<double>(), sizes.back());
  EXPECT_GT(json["counts"]["evaluations_per_sample"].get<double>(), size["mean"].get<double>());
  EXPECT_GT(json["counts"]["estimated_error"].get<double>(), 0);
  EXPECT_LT(json["counts"]["estimated_error"].get<double>(), 0.1);
  EXPECT_EQ(json["skipped"][0]["what"], "1 tiles");
}

TEST(BuildCut, ChecksItsInputs) {
  Report report;
  for (const double error : {0.0, 1.5, std::nan("")})
    expect_error(ErrorCode::out_of_range, {"error"}, [&] { cut_with(1, report, error); });
  Lights elsewhere = lights();
  elsewhere.anchor.x += 1;
  expect_error(ErrorCode::invalid_data, {"anchor", "same scene"},
               [&] { build_cut(gbuffer(), elsewhere, {}, report); });
  Lights list = lights();
  list.levels.clear();
  expect_error(ErrorCode::invalid_data, {"--method tree"}, [&] { build_cut(gbuffer(), list, {}, report); });
}

TEST(BuildCut, OfNoLights) {
  Report report;
  Lights none;
  none.method = "tree";
  none.scene_radius = 3.2;
  none.levels = {0, 0};
  const Cut cut = build_cut(gbuffer(), none, {}, report);
  EXPECT_EQ(cut.tiles.size(), 15U);
  EXPECT_TRUE(cut.nodes.empty());
}

}  // namespace
}  // namespace vsgl::test
