#include "cluster/traverse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "../expect_error.h"
#include "../synthetic_room.h"
#include "../synthetic_tree.h"
#include "cluster/cluster.h"
#include "cluster/evaluate.h"

namespace vsgl::test {
namespace {

using interop::Cluster;

// A room of two lamps, a glossy floor and a glossy sphere, cut for an image of 5 x 3 tiles, partly cut off.
struct Room {
  GBuffer gbuffer = room_gbuffer(72, 40);
  Lights lights = tree_of(room_rsm(32, 2));
  std::vector<Cluster> clusters = pack_clusters(lights);

  TreeTraversal traversal() const { return {gbuffer, lights, clusters}; }
};
const Room& room() {
  static const Room instance;
  return instance;
}

constexpr int kTiles = 15;

std::vector<std::uint32_t> lit_leaves() {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < room().clusters.size(); ++i)
    if (room().clusters[i].children == 0 && room().clusters[i].inverse_variance > 0) out.push_back(i);
  return out;
}

std::vector<std::uint32_t> nodes_of(const TileCut& cut) {
  std::vector<std::uint32_t> out;
  for (const TileCut::Entry& entry : cut.entries) out.push_back(entry.node);
  return out;
}

std::array<double, kTileSamples> light_of(const std::vector<std::uint32_t>& nodes,
                                          const TileSamples& samples) {
  const SampleReceivers receivers = sample_receivers(room().gbuffer, samples);
  std::array<double, kTileSamples> sum{};
  for (const std::uint32_t node : nodes) {
    ClusterLight light;
    evaluate(room().clusters[node], receivers, light);
    for (std::size_t k = 0; k < kTileSamples; ++k)
      if (samples.present >> k & 1U) sum[k] += static_cast<double>(light.value[k]);
  }
  return sum;
}

double power_below(const std::vector<std::uint32_t>& nodes) {
  double sum = 0;
  for (const std::uint32_t node : nodes) {
    const interop::Light& light = room().lights.lights[node];
    sum += luminance(to_double(light.power_diffuse) + to_double(light.power_specular));
  }
  return sum;
}

TEST(Samples, AreTheCornersOfATilesCells) {
  const TileSamples samples = tile_samples(room().gbuffer, 1);
  EXPECT_EQ(samples.present, 0xFFFFU);
  EXPECT_EQ(samples.pixel[0], 16U);
  EXPECT_EQ(samples.pixel[3], 31U);
  EXPECT_EQ(samples.pixel[6], 26U + 5 * 72);
  EXPECT_EQ(samples.pixel[15], 31U + 15 * 72);
}

TEST(Samples, ReplaceBackgroundAndPixelsBeyondTheImage) {
  GBuffer gbuffer = room().gbuffer;
  gbuffer.pixels[0].id = interop::NO_INSTANCE;
  for (std::size_t y = 0; y < 4; ++y)
    for (std::size_t x = 4; x < 8; ++x) gbuffer.pixels[y * 72 + x].id = interop::NO_INSTANCE;
  const TileSamples first = tile_samples(gbuffer, 0);
  EXPECT_EQ(first.pixel[0], 1U);
  EXPECT_EQ(first.present, 0xFFFFU & ~2U);
  const TileSamples last = tile_samples(gbuffer, 14);  // of 8 x 8 pixels
  EXPECT_EQ(last.present, 0x0033U);
  EXPECT_EQ(last.pixel[0], 64U + 32 * 72);
  EXPECT_EQ(last.pixel[5], 69U + 37 * 72);
}

TEST(Traversal, RefusesLightsThatAreNoTree) {
  Lights list = room().lights;
  list.levels.clear();
  expect_error(ErrorCode::invalid_data, {"lights: method", "--method tree"},
               [&] { TreeTraversal(room().gbuffer, list, room().clusters); });
}

TEST(Traversal, TakesAllLeavesThatShineWithoutTolerance) {
  const std::vector<std::uint32_t> leaves = lit_leaves();
  for (int tile = 0; tile < kTiles; ++tile) {
    const TileSamples samples = tile_samples(room().gbuffer, tile);
    const TileCut cut = room().traversal().cut(samples, {.threshold = 0, .floor = 0}, {});
    const auto found = light_of(nodes_of(cut), samples), all = light_of(leaves, samples);
    for (std::size_t k = 0; k < kTileSamples; ++k) EXPECT_NEAR(found[k], all[k], 1e-3 * all[k]) << tile;
    for (const TileCut::Entry& entry : cut.entries)
      EXPECT_TRUE(room().clusters[entry.node].children == 0 || entry.share == 0) << entry.node;
    EXPECT_GT(cut.entries.size(), leaves.size() / 3);
  }
}

TEST(Traversal, CoversEveryLitLeafOnce) {
  for (const double error : {0.5, 0.05, 0.005})
    for (int tile = 0; tile < kTiles; ++tile) {
      const TileSamples samples = tile_samples(room().gbuffer, tile);
      const TileCut cut = room().traversal().cut(samples, room().traversal().criterion(error), {});
      EXPECT_NEAR(power_below(nodes_of(cut)), power_below({0}), 1e-4 * power_below({0}));
      EXPECT_TRUE(std::ranges::is_sorted(cut.entries, std::less{}, &TileCut::Entry::node));
      std::vector<int> covered(room().clusters.size());
      for (const std::uint32_t node : nodes_of(cut)) ++covered[node];
      for (std::uint32_t node = 0; node < covered.size(); ++node)
        if (const std::uint32_t first = room().clusters[node].children; first != 0)
          for (std::uint32_t child = first; child < first + 4; ++child) covered[child] += covered[node];
      for (const std::uint32_t leaf : lit_leaves()) EXPECT_EQ(covered[leaf], 1) << leaf;
    }
}

// At the samples themselves, where nothing but the acceptance test decides.
TEST(Traversal, KeepsItsPromiseAtTheSamples) {
  const std::vector<std::uint32_t> leaves = lit_leaves();
  for (const double error : {0.05, 0.02, 0.005}) {
    std::vector<double> errors;
    std::size_t entries = 0;
    for (int tile = 0; tile < kTiles; ++tile) {
      const TileSamples samples = tile_samples(room().gbuffer, tile);
      const TileCut cut = room().traversal().cut(samples, room().traversal().criterion(error), {});
      const auto found = light_of(nodes_of(cut), samples), all = light_of(leaves, samples);
      for (std::size_t k = 0; k < kTileSamples; ++k)
        if (samples.present >> k & 1U) errors.push_back(std::abs(found[k] / all[k] - 1));
      entries += cut.entries.size();
      EXPECT_LE(cut.error, error);
    }
    std::ranges::sort(errors);
    EXPECT_LT(errors[errors.size() / 2], error / 4);
    EXPECT_LT(errors[errors.size() * 95 / 100], error);
    EXPECT_LT(entries, kTiles * leaves.size()) << "the cut saves nothing";
  }
}

TEST(Traversal, CutsDeeperForSmallerErrors) {
  const TileSamples samples = tile_samples(room().gbuffer, 7);
  std::size_t last = 0;
  for (const double error : {0.5, 0.1, 0.02, 0.004}) {
    const TileCut cut = room().traversal().cut(samples, room().traversal().criterion(error), {});
    EXPECT_GT(cut.entries.size(), last);
    last = cut.entries.size();
  }
}

TEST(Traversal, LowersItsThresholdUntilTheEstimateHolds) {
  const TileSamples samples = tile_samples(room().gbuffer, 7);
  CutCriterion criterion{.threshold = 0.1F, .floor = room().traversal().criterion(0.1).floor};
  const TileCut once = room().traversal().cut(samples, criterion, {});
  criterion.error = once.error / 8;
  const TileCut lowered = room().traversal().cut(samples, criterion, {});
  EXPECT_LE(lowered.error, once.error / 8);
  EXPECT_GT(lowered.entries.size(), once.entries.size());
  criterion.error = 0;
  const TileCut all = room().traversal().cut(samples, criterion, {});
  const auto found = light_of(nodes_of(all), samples), whole = light_of(lit_leaves(), samples);
  for (std::size_t k = 0; k < kTileSamples; ++k) EXPECT_NEAR(found[k], whole[k], 1e-4 * whole[k]);
}

// What siblings differ by hides the more of what lies below the smaller the error is.
TEST(Traversal, TrustsItsEstimateLessWhereTheErrorIsSmall) {
  const auto caution = [](double error) { return room().traversal().criterion(error).caution; };
  EXPECT_EQ(caution(0.1), 1);
  EXPECT_EQ(caution(0.05), 1);
  EXPECT_NEAR(caution(0.0125), 2, 1e-12);
  EXPECT_EQ(caution(1e-3), caution(1e-4));
  const TileSamples samples = tile_samples(room().gbuffer, 7);
  CutCriterion criterion{.floor = room().traversal().criterion(0.1).floor};
  const double plain = room().traversal().cut(samples, criterion, {}).error;
  criterion.caution = 3;
  EXPECT_NEAR(room().traversal().cut(samples, criterion, {}).error, 3 * plain, 1e-9 * plain);
}

std::vector<std::uint32_t> parents() {
  std::vector<std::uint32_t> out(room().clusters.size());
  for (std::uint32_t node = 0; node < out.size(); ++node)
    if (const std::uint32_t first = room().clusters[node].children; first != 0)
      for (std::uint32_t child = first; child < first + 4; ++child) out[child] = node;
  return out;
}

// Each entry is a leaf, or small, or the sum over its siblings agrees with its parent, shadowed and not.
TEST(Traversal, AcceptsByItsCriterion) {
  const NodeVisibility spotted = [](std::uint32_t node, const TileSamples& all) {
    return all.present & (node * 2654435761U >> 8);
  };
  const std::vector<std::uint32_t> parent_of = parents();
  const std::vector<std::uint32_t>& levels = room().lights.levels;
  CutCriterion criterion = room().traversal().criterion(0.02);
  criterion.error = std::numeric_limits<double>::infinity();
  const double eps = static_cast<double>(criterion.threshold);
  std::size_t by_difference = 0;
  for (const int tile : {2, 7}) {
    const TileSamples samples = tile_samples(room().gbuffer, tile);
    const auto lit = [&](std::uint32_t node) {
      auto light = light_of({node}, samples);
      for (std::size_t k = 0; k < kTileSamples; ++k)
        if ((spotted(node, samples) >> k & 1U) == 0) light[k] = 0;
      return light;
    };
    std::array<double, kTileSamples> whole;
    whole.fill(static_cast<double>(criterion.floor));
    for (std::uint32_t node = levels[criterion.start_level]; node < levels[criterion.start_level + 1]; ++node)
      for (std::size_t k = 0; k < kTileSamples; ++k) whole[k] += lit(node)[k];

    for (const TileCut::Entry& entry : room().traversal().cut(samples, criterion, spotted).entries) {
      const auto light = light_of({entry.node}, samples);
      double share = 0;
      for (std::size_t k = 0; k < kTileSamples; ++k) share = std::max(share, light[k] / whole[k]);
      EXPECT_NEAR(share, static_cast<double>(entry.share), 1e-3 * share + 1e-20);
      if (room().clusters[entry.node].children == 0 || share < 1.001 * eps) continue;
      ASSERT_GE(entry.node, levels[criterion.start_level + 1]) << "a start node without a reason";
      const std::uint32_t parent = parent_of[entry.node], first = room().clusters[parent].children;
      auto difference = light_of({parent}, samples), lit_difference = lit(parent);
      for (std::uint32_t child = first; child < first + 4; ++child)
        for (std::size_t k = 0; k < kTileSamples; ++k) {
          difference[k] -= light_of({child}, samples)[k];
          lit_difference[k] -= lit(child)[k];
        }
      for (std::size_t k = 0; k < kTileSamples; ++k) {
        EXPECT_LT(std::abs(difference[k]), 1.01 * eps * whole[k]) << entry.node;
        EXPECT_LT(std::abs(lit_difference[k]), 2.01 * eps * whole[k]) << entry.node;
      }
      ++by_difference;
    }
  }
  EXPECT_GT(by_difference, 20U);
}

TEST(Traversal, RefinesWhereVisibilityDiffersWithinANode) {
  const TileSamples samples = tile_samples(room().gbuffer, 7);
  const CutCriterion criterion = room().traversal().criterion(0.05);
  const TileCut plain = room().traversal().cut(samples, criterion, {});
  const NodeVisibility every_second = [](std::uint32_t node, const TileSamples& all) {
    return node % 2 == 0 ? all.present : 0;
  };
  const TileCut shadowed = room().traversal().cut(samples, criterion, every_second);
  EXPECT_GT(shadowed.entries.size(), plain.entries.size());
  for (const TileCut::Entry& entry : shadowed.entries)
    EXPECT_EQ(entry.visible, entry.node % 2 == 0 ? samples.present : 0U);
}

TEST(Traversal, AsksForTheVisibilityOfEachNodeOnce) {
  std::map<std::uint32_t, int> asked;
  const NodeVisibility count = [&](std::uint32_t node, const TileSamples& all) {
    ++asked[node];
    return all.present;
  };
  const TileSamples samples = tile_samples(room().gbuffer, 4);
  const TileCut cut = room().traversal().cut(samples, room().traversal().criterion(0.02), count);
  EXPECT_EQ(cut.evaluations, asked.size() * cut.samples);
  for (const auto& [node, times] : asked) EXPECT_EQ(times, 1) << node;
}

// A tree of `node` over four texels that share its power.
Lights four_texels(interop::Light node, const std::array<interop::vec3, 4>& places) {
  Lights lights;
  lights.method = "tree";
  lights.levels = {0, 1, 5};
  node.children = 1;
  lights.lights = {node};
  node.children = 0;
  node.variance = 1e-8f;
  node.power_diffuse = to_float(0.25 * to_double(node.power_diffuse));
  node.power_specular = to_float(0.25 * to_double(node.power_specular));
  for (const interop::vec3 place : places) {
    node.position = place;
    lights.lights.push_back(node);
  }
  return lights;
}

interop::Surface white_floor() {
  interop::Surface s{};
  s.normal = s.shading_normal = {0, 1, 0};
  s.diffuse = {1, 1, 1};
  s.alpha = 1;
  return s;
}

// One tile; all of its pixels are `s`.
GBuffer tile_of(const interop::Surface& s, Vec3 camera) {
  GBuffer tile;
  tile.width = tile.height = 16;
  tile.camera = camera;
  tile.pixels.assign(256, s);
  return tile;
}

using Nodes = std::vector<std::uint32_t>;
Nodes cut_of(const GBuffer& tile, const Lights& lights, float floor) {
  const std::vector<Cluster> clusters = pack_clusters(lights);
  const CutCriterion criterion{.threshold = 0.01F, .floor = floor, .start_level = 0};
  return nodes_of(TreeTraversal(tile, lights, clusters).cut(tile_samples(tile, 0), criterion, {}));
}

// Of a light at the tile's first sample.
float light_at_first(const GBuffer& tile, const Lights& lights, std::size_t light) {
  ClusterLight out;
  evaluate(pack_clusters(lights)[light], sample_receivers(tile, tile_samples(tile, 0)), out);
  return out.value[0];
}

// A lamp right above a pixel between the samples, which hardly see it.
TEST(Traversal, LooksAtPixelsNearAClusterBetweenTheSamples) {
  interop::Light node{};
  node.position = {2, 0.05f, 2};
  node.normal = node.shading_normal = node.incident = {0, -1, 0};
  node.power_diffuse = {4, 4, 4};
  node.variance = 1e-4f;
  const Lights lights =
      four_texels(node, {{{1.985f, 0.05f, 2}, {1.995f, 0.05f, 2}, {2.005f, 0.05f, 2}, {2.015f, 0.05f, 2}}});
  GBuffer floor = tile_of(white_floor(), {0, 1, 0});
  for (int pixel = 0; pixel < 256; ++pixel)
    floor.pixels[static_cast<std::size_t>(pixel)].position = {static_cast<float>(pixel % 16), 0,
                                                              static_cast<float>(pixel / 16)};
  EXPECT_EQ(cut_of(floor, lights, 0.05F), (Nodes{1, 2, 3, 4}));
  floor.pixels[2 * 16 + 2].id = interop::NO_INSTANCE;  // the others are a metre away
  EXPECT_EQ(cut_of(floor, lights, 0.05F), Nodes{0});
}

// One centimetre large, a metre away from the floor's pixels, which it faces, at that height.
interop::Light part_of_wall(float height) {
  interop::Light node{};
  node.position = {0, height, -1};
  node.normal = node.shading_normal = node.incident = {0, 0, 1};
  node.power_diffuse = {4, 4, 4};
  node.variance = 1e-4f;
  return node;
}

// A node whose mean lies below the receivers' horizon while half of its texels shine: a wall that reaches
// from below the floor to above it.
TEST(Traversal, DoesNotTrustANodeHiddenByItsHorizon) {
  const interop::Light node = part_of_wall(-0.01f);
  const Lights lights =
      four_texels(node, {{{0, -0.03f, -1}, {0, -0.02f, -1}, {0, -0.01f, -1}, {0, 0.02f, -1}}});
  const GBuffer floor = tile_of(white_floor(), {0, 1, 0});
  ASSERT_LT(light_at_first(floor, lights, 0), 0.05F * 0.01F) << "not hidden";
  EXPECT_EQ(cut_of(floor, lights, 0.05F), (Nodes{1, 2, 3, 4}));
}

// The mean lies far below the horizon, and so do all texels but one, ten deviations away.
TEST(Traversal, ReachesTexelsFarFromTheirNode) {
  const interop::Light node = part_of_wall(-0.03f);
  const auto cut_with = [&](float height) {
    const Lights lights =
        four_texels(node, {{{0, -0.04f, -1}, {0, -0.04f, -1}, {0, -0.04f, -1}, {0, height, -1}}});
    EXPECT_NEAR(pack_clusters(lights)[0].reach, height > 0 ? height + 0.03F : 0.02F, 1e-3F);
    return cut_of(tile_of(white_floor(), {0, 1, 0}), lights, 0.05F);
  };
  EXPECT_EQ(cut_with(0.07F), (Nodes{1, 2, 3, 4}));
  EXPECT_EQ(cut_with(-0.04F), Nodes{0});
}

// Four mirror-like texels on a ceiling, of which one reflects the source towards a mirror-like floor right
// where that reflects it to the camera. Seen from the floor, the mean of the four does neither.
TEST(Traversal, LooksForGlintsThatTheMeanDoesNotShow) {
  interop::Light node{};
  node.position = {0.4f, 1, -1};
  node.normal = node.shading_normal = {0, -1, 0};
  node.incident = to_float(normalise(Vec3{0, -1, -1}));
  node.power_specular = {4, 4, 4};
  node.ndf = interop::NDF_GGX;
  node.alpha = 0.03f;
  node.variance = 0.04f;
  const Lights lights = four_texels(node, {{{0, 1, -1}, {0.5f, 1, -1}, {0.5f, 1, -1}, {0.6f, 1, -1}}});
  interop::Surface mirror = white_floor();
  std::swap(mirror.diffuse, mirror.specular);
  mirror.ndf = interop::NDF_GGX;
  mirror.alpha = 0.03f;
  const GBuffer floor = tile_of(mirror, {0, 1, 1});
  const float texel = light_at_first(floor, lights, 1);
  ASSERT_GT(texel, 100 * light_at_first(floor, lights, 0)) << "not hidden";
  EXPECT_EQ(cut_of(floor, lights, 5 * texel), (Nodes{1, 2, 3, 4}));
  // No longer where the floor reflects the ceiling to.
  EXPECT_EQ(cut_of(tile_of(mirror, {0, 1, -1}), lights, 5 * texel), Nodes{0});
}

TEST(Traversal, SkipsNodesWithoutPowerAndTilesWithoutPixels) {
  Room dark = room();
  for (interop::Light& light : dark.lights.lights) light.power_diffuse = light.power_specular = {};
  dark.clusters = pack_clusters(dark.lights);
  const CutCriterion criterion = dark.traversal().criterion(0.02);
  EXPECT_EQ(criterion.floor, 0);
  EXPECT_TRUE(dark.traversal().cut(tile_samples(dark.gbuffer, 0), criterion, {}).entries.empty());
  const TileCut nothing = room().traversal().cut(TileSamples{}, criterion, {});
  EXPECT_EQ(nothing.entries.size() + nothing.samples + nothing.evaluations, 0U);
}

}  // namespace
}  // namespace vsgl::test
