#include "stages/lights/tree_split.h"

#include <algorithm>
#include <limits>
#include <span>

namespace vsgl {
namespace {

// Length of a unit normal among the features, in scene radii: opposite normals are further apart than any two
// points, so that clusters of mixed orientation are split first.
constexpr double kNormalScale = 2;

// The dimension along which the texels reach furthest.
std::size_t longest_axis(std::span<const LitTexel> texels) {
  std::array<float, 6> low = texels.front().feature, high = low;
  for (const LitTexel& texel : texels)
    for (std::size_t axis = 0; axis < 6; ++axis) {
      low[axis] = std::min(low[axis], texel.feature[axis]);
      high[axis] = std::max(high[axis], texel.feature[axis]);
    }
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 6; ++axis)
    if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
  return longest;
}

// Total order along an axis.
struct Before {
  std::size_t axis;

  bool operator()(const LitTexel& a, const LitTexel& b) const {
    return a.feature[axis] != b.feature[axis] ? a.feature[axis] < b.feature[axis] : a.index < b.index;
  }
};

// How many of the first texels hold half of the importance; at least an eighth of all on either side, so that
// the tree stays shallow.
std::size_t weighted_half(std::span<LitTexel> texels, Before before) {
  double wanted = 0;
  for (const LitTexel& texel : texels) wanted += 0.5 * static_cast<double>(texel.importance);
  auto begin = texels.begin(), end = texels.end();
  while (end - begin > 1) {
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, before);
    double held = 0;
    for (auto texel = begin; texel != middle; ++texel) held += static_cast<double>(texel->importance);
    if (held <= wanted) {
      wanted -= held;
      begin = middle;
    } else {
      end = middle;
    }
  }
  const std::size_t margin = texels.size() / 8 + 2;
  if (texels.size() <= 2 * margin) return texels.size() / 2;
  return std::clamp(static_cast<std::size_t>(begin - texels.begin()), margin, texels.size() - margin);
}

// Splits texels in two along their longest extent and returns how many come first: nearly half of them, so
// that `residue` remains modulo 3. With nodes of four children a tree of m leaves has no empty one if m = 1
// modulo 3; so halves are kept at 2, quarters at 1.
std::size_t split(std::span<LitTexel> texels, std::size_t residue, bool weighted) {
  if (texels.size() <= residue) return texels.size();
  const Before before{longest_axis(texels)};
  const std::size_t half = weighted ? weighted_half(texels, before) : texels.size() / 2;
  const std::size_t count = half - 1 + (residue + 4 - half % 3) % 3;
  std::nth_element(texels.begin(), texels.begin() + static_cast<std::ptrdiff_t>(count), texels.end(), before);
  return count;
}

// Inner nodes of a tree of so many texels, as split() makes it.
constexpr std::uint32_t inner_nodes(std::uint32_t texels) {
  return (texels + 1) / 3;
}

// Of an inner node: child k holds the texels [split[k], split[k + 1]).
using Split = std::array<std::uint32_t, 5>;

// Splits the texels from the root down; large halves are tasks of their own.
class Splitter {
 public:
  Splitter(std::vector<LitTexel>& texels, bool weighted)
      : texels_(texels), weighted_(weighted), splits_(inner_nodes(count())) {}

  // Of all inner nodes: each before those below it, and these child by child.
  std::vector<Split> run() {
#pragma omp parallel
#pragma omp single
    split_node(0, count(), 0);
    return std::move(splits_);
  }

 private:
  static constexpr std::uint32_t kTask = 2048;  // texels

  std::uint32_t count() const {
    return static_cast<std::uint32_t>(texels_.size());
  }

  std::uint32_t middle(std::uint32_t begin, std::uint32_t end, std::size_t residue) {
    const std::span part = std::span(texels_).subspan(begin, end - begin);
    return begin + static_cast<std::uint32_t>(split(part, residue, weighted_));
  }

  // `index`: of the node among the inner ones.
  void split_node(std::uint32_t begin, std::uint32_t end, std::uint32_t index) {
    if (end - begin < 2) return;
    const std::uint32_t half = middle(begin, end, 2);
    const std::uint32_t first = index + 1, second = first + (half - begin) / 3;
    splits_[index] = {begin, 0, half, 0, end};
    if (end - begin > kTask) {
#pragma omp task
      splits_[index][1] = split_half(begin, half, first);
#pragma omp task
      splits_[index][3] = split_half(half, end, second);
    } else {
      splits_[index][1] = split_half(begin, half, first);
      splits_[index][3] = split_half(half, end, second);
    }
  }

  // Two children of a node; `index`: of the first of the two. Returns where the second one begins.
  std::uint32_t split_half(std::uint32_t begin, std::uint32_t end, std::uint32_t index) {
    const std::uint32_t quarter = middle(begin, end, 1);
    split_node(begin, quarter, index);
    split_node(quarter, end, index + inner_nodes(quarter - begin));
    return quarter;
  }

  std::vector<LitTexel>& texels_;
  bool weighted_;
  std::vector<Split> splits_;
};

// Puts the nodes in order, level by level.
TexelTree lay_out(std::vector<LitTexel> texels, const std::vector<Split>& splits) {
  TexelTree tree{.texels = std::move(texels), .nodes = {}, .levels = {0}};
  const std::size_t count = tree.texels.empty() ? 0 : 1 + 4 * splits.size();
  tree.nodes.reserve(count);
  std::vector<std::uint32_t> inner;  // of each node: its index among the inner ones, if it is one
  inner.reserve(count);
  const auto add = [&](std::uint32_t begin, std::uint32_t end, std::uint32_t index) {
    tree.nodes.push_back({.begin = begin, .end = end});
    inner.push_back(index);
  };
  if (count > 0) add(0, static_cast<std::uint32_t>(tree.texels.size()), 0);
  for (std::size_t node = 0; node < count; ++node) {
    if (node == tree.levels.back()) tree.levels.push_back(static_cast<std::uint32_t>(tree.nodes.size()));
    if (tree.nodes[node].size() < 2) continue;
    tree.nodes[node].children = static_cast<std::uint32_t>(tree.nodes.size());
    const Split& split = splits[inner[node]];
    std::uint32_t index = inner[node] + 1;
    for (std::size_t k = 0; k < 4; ++k) {
      add(split[k], split[k + 1], index);
      index += inner_nodes(split[k + 1] - split[k]);
    }
  }
  if (count == 0) tree.levels.push_back(0);
  return tree;
}

}  // namespace

std::vector<LitTexel> lit_texels(const Rsm& rsm, const Pdf* pdf) {
  const auto texels = static_cast<std::uint32_t>(rsm.size) * static_cast<std::uint32_t>(rsm.size);
  const auto scale = static_cast<float>(kNormalScale * rsm.scene_radius);
  std::vector<LitTexel> lit;
  for (std::uint32_t layer = 0; layer < rsm.layers.size(); ++layer)
    for (std::uint32_t texel = 0; texel < texels; ++texel) {
      const interop::Moments& moments = rsm.layers[layer].pyramid[texel];
      if (!(moments.weight > 0)) continue;
      const interop::vec3 &y = moments.position, &n = moments.normal_mean;
      lit.push_back({.feature = {y.x, y.y, y.z, scale * n.x, scale * n.y, scale * n.z},
                     .importance = pdf ? pdf->layers[layer].pyramid[texel] * moments.weight : 1,
                     .index = layer * texels + texel});
    }
  return lit;
}

TexelTree split_texels(std::vector<LitTexel> texels, bool weighted) {
  const std::vector<Split> splits = Splitter(texels, weighted).run();
  return lay_out(std::move(texels), splits);
}

}  // namespace vsgl
