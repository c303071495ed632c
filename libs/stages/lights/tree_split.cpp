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

std::span<LitTexel> texels_of(TexelTree& tree, std::uint32_t begin, std::uint32_t end) {
  return std::span(tree.texels).subspan(begin, end - begin);
}

// Splits the nodes `inner`, whose children are the last nodes of the tree: all into halves, then all halves
// into quarters.
void split_level(TexelTree& tree, const std::vector<std::uint32_t>& inner, bool weighted) {
  std::vector<std::uint32_t> middle(inner.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t k = 0; k < inner.size(); ++k) {
    const TreeNode& node = tree.nodes[inner[k]];
    middle[k] =
        node.begin + static_cast<std::uint32_t>(split(texels_of(tree, node.begin, node.end), 2, weighted));
  }
#pragma omp parallel for schedule(dynamic)
  for (std::size_t k = 0; k < 2 * inner.size(); ++k) {
    const TreeNode& node = tree.nodes[inner[k / 2]];
    const std::uint32_t begin = k % 2 == 0 ? node.begin : middle[k / 2];
    const std::uint32_t end = k % 2 == 0 ? middle[k / 2] : node.end;
    const auto quarter = begin + static_cast<std::uint32_t>(split(texels_of(tree, begin, end), 1, weighted));
    const std::size_t child = node.children + k % 2 * 2;
    tree.nodes[child] = {begin, quarter};
    tree.nodes[child + 1] = {quarter, end};
  }
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
  TexelTree tree{.texels = std::move(texels), .nodes = {}, .levels = {0}};
  if (tree.texels.empty()) tree.levels.push_back(0);
  if (tree.texels.empty()) return tree;
  tree.nodes.push_back({.begin = 0, .end = static_cast<std::uint32_t>(tree.texels.size())});
  for (std::vector<std::uint32_t> inner;; inner.clear()) {
    const std::uint32_t first = tree.levels.back();
    const auto end = static_cast<std::uint32_t>(tree.nodes.size());
    tree.levels.push_back(end);
    for (std::uint32_t node = first; node < end; ++node) {
      if (tree.nodes[node].size() < 2) continue;
      tree.nodes[node].children = end + 4 * static_cast<std::uint32_t>(inner.size());
      inner.push_back(node);
    }
    if (inner.empty()) return tree;
    tree.nodes.resize(end + 4 * inner.size());
    split_level(tree, inner, weighted);
  }
}

}  // namespace vsgl
