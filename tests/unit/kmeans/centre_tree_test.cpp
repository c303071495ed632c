#include "kmeans/centre_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "interop/kmeans.h"
#include "math/sampling.h"

namespace vsgl {
namespace {

using interop::CentreNode;
using interop::Feature;
using interop::vec3;

gpu::Device& device() {
  static gpu::Device instance({.compute_only = true});
  return instance;
}

float hashed(std::uint32_t i, std::uint32_t what, int steps) {
  return static_cast<float>(std::floor(pcg3d({i, what, 3})[0] * 0x1p-32 * steps) / steps);
}

// On a grid of `steps` places a side.
std::vector<Feature> hashed_centres(std::uint32_t count, int steps) {
  std::vector<Feature> centres;
  for (std::uint32_t i = 0; i < count; ++i)
    centres.push_back({{hashed(i, 0, steps), hashed(i, 1, steps), hashed(i, 2, steps)},
                       {hashed(i, 3, steps), hashed(i, 4, steps), hashed(i, 5, steps)}});
  return centres;
}

std::vector<CentreNode> build(const std::vector<Feature>& centres) {
  const gpu::Buffer buffer = gpu::Buffer::from(device(), centres);
  CentreTree tree(device(), static_cast<std::uint32_t>(centres.size()));
  gpu::Commands commands(device());
  tree.record(commands, buffer, "tree");
  Report report;
  commands.submit(report);
  return tree.nodes().download<CentreNode>(2 * centres.size() - 1);
}

std::array<float, 6> values(const Feature& f) {
  return {f.place.x, f.place.y, f.place.z, f.facing.x, f.facing.y, f.facing.z};
}

// Checks a node and all below it; counts how often each cluster is met. Returns the depth.
int check(const std::vector<CentreNode>& nodes, const std::vector<Feature>& centres, std::uint32_t node,
          std::vector<int>& met) {
  const auto low = values(nodes[node].low), high = values(nodes[node].high);
  if (node >= centres.size() - 1) {
    ++met.at(nodes[node].left);
    EXPECT_EQ(low, values(centres[nodes[node].left]));
    EXPECT_EQ(high, low);
    return 1;
  }
  int depth = 0;
  std::array<float, 6> lowest, highest;
  lowest.fill(2);
  highest.fill(-2);
  for (const std::uint32_t child : {nodes[node].left, nodes[node].right}) {
    EXPECT_TRUE(nodes.at(child).first == nodes[node].first || nodes.at(child).last == nodes[node].last);
    depth = std::max(depth, 1 + check(nodes, centres, child, met));
    for (std::size_t k = 0; k < 6; ++k) {
      lowest[k] = std::min(lowest[k], values(nodes[child].low)[k]);
      highest[k] = std::max(highest[k], values(nodes[child].high)[k]);
    }
  }
  EXPECT_EQ(low, lowest) << node;
  EXPECT_EQ(high, highest) << node;
  return depth;
}

// Of centres all over the cube, on few places, and all in one.
TEST(CentreTree, BoundsEveryCentreOnce) {
  for (const std::uint32_t count : {1u, 2u, 3u, 4u, 5u, 64u, 65u, 1000u, 5000u})
    for (const int steps : {1 << 20, 3, 1}) {
      SCOPED_TRACE(std::to_string(count) + " centres, " + std::to_string(steps) + " steps");
      const auto centres = hashed_centres(count, steps);
      const auto nodes = build(centres);
      std::vector<int> met(count);
      EXPECT_LE(check(nodes, centres, 0, met), 64);
      EXPECT_EQ(met, std::vector<int>(count, 1));
    }
}

}  // namespace
}  // namespace vsgl
