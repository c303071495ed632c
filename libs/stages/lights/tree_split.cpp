#include "stages/lights/tree_split.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "math/interop_vec.h"

namespace vsgl {
namespace {

// Length of a unit normal among the features, in root mean square distances of the lit positions from their
// mean, and how much of a specular surface's bumps it holds; found by measurement (docs/sampling.md).
constexpr double kNormalScale = 1;
constexpr double kBumps = 0.3;
// Steps in which features are counted, in that distance: wide enough that what rounding leaves of equal
// coordinates is equal, fine enough for RSMs of 4096 texels a side.
constexpr double kStep = 1.0 / 32768;
// Spreads that differ by less are equal: shapes with symmetries are split the same way wherever they are.
constexpr double kTie = 1e-3;

// Moments of one feature over some texels, from a reference near them.
struct Sums {
  double count = 0, first = 0, second = 0;

  void add(double x) {
    count += 1;
    first += x;
    second += x * x;
  }
  void add(const Sums& other) {
    count += other.count;
    first += other.first;
    second += other.second;
  }
  // Sum of squared distances from the mean.
  double spread() const { return count > 0 ? second - first * first / count : 0; }
};

// What remains of the spread when the texels of `part` are split off from those of `all`.
double spread_of_both(const Sums& all, const Sums& part) {
  const Sums rest{all.count - part.count, all.first - part.first, all.second - part.second};
  return part.spread() + rest.spread();
}

// The dimension along which the texels spread most.
std::size_t widest_axis(std::span<const LitTexel> texels) {
  std::array<double, 6> first = {}, second = {};
  const auto& reference = texels.front().feature;
  for (const LitTexel& texel : texels)
    for (std::size_t axis = 0; axis < 6; ++axis) {
      const auto x = static_cast<double>(texel.feature[axis] - reference[axis]);
      first[axis] += x;
      second[axis] += x * x;
    }
  const auto spread = [&](std::size_t axis) {
    return Sums{static_cast<double>(texels.size()), first[axis], second[axis]}.spread();
  };
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < 6; ++axis)
    if (spread(axis) > (1 + kTie) * spread(widest)) widest = axis;
  return widest;
}

// Total order along an axis.
struct Before {
  std::size_t axis;

  bool operator()(const LitTexel& a, const LitTexel& b) const {
    return a.feature[axis] != b.feature[axis] ? a.feature[axis] < b.feature[axis] : a.index < b.index;
  }
};

// Trees of m leaves whose inner nodes all have four children exist for m = 1 modulo 3; so halves are kept at
// 2 and quarters at 1 modulo 3: `residue`.
std::size_t aligned(std::size_t count, std::size_t residue) {
  return count - 1 + (residue + 4 - count % 3) % 3;
}

// How many of some sorted texels make the first part of the best split.
std::size_t best_of_sorted(std::span<const LitTexel> texels, std::size_t axis, std::size_t residue) {
  const auto at = [&](std::size_t k) {
    return static_cast<double>(texels[k].feature[axis] - texels.front().feature[axis]);
  };
  Sums all, part;
  for (std::size_t k = 0; k < texels.size(); ++k) all.add(at(k));
  std::size_t best = residue;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t count = 1; count < texels.size(); ++count) {
    part.add(at(count - 1));
    const double spread = spread_of_both(all, part);
    if (count % 3 != residue || spread >= (1 - kTie) * least) continue;
    least = spread;
    best = count;
  }
  return best;
}

// The same of many texels in any order, between equal bins along the axis. At least an eighth of the texels
// is on either side, so that the tree stays shallow; where bins do not allow that, half of them.
std::size_t best_of_bins(std::span<const LitTexel> texels, std::size_t axis) {
  const auto [low, high] = std::minmax_element(
      texels.begin(), texels.end(),
      [axis](const LitTexel& a, const LitTexel& b) { return a.feature[axis] < b.feature[axis]; });
  const float origin = low->feature[axis], extent = high->feature[axis] - origin;
  if (!(extent > 0)) return texels.size() / 2;
  constexpr std::size_t kBins = 32;
  constexpr float kShift = 0.1237f;  // keeps regular grids of texels off the borders between bins
  std::array<Sums, kBins> bins;
  for (const LitTexel& texel : texels) {
    const float x = texel.feature[axis] - origin;
    bins[static_cast<std::size_t>(x / extent * (kBins - 2 * kShift) + kShift)].add(static_cast<double>(x));
  }
  Sums all, part;
  for (const Sums& bin : bins) all.add(bin);
  std::size_t best = texels.size() / 2;
  double least = std::numeric_limits<double>::infinity();
  for (const Sums& bin : bins) {
    part.add(bin);
    const double spread = spread_of_both(all, part);
    if (8 * std::min(part.count, all.count - part.count) < all.count || spread >= (1 - kTie) * least)
      continue;
    least = spread;
    best = static_cast<std::size_t>(part.count);
  }
  return best;
}

// Splits texels in two along their widest axis, where the spread of both parts is least, and returns how many
// come first.
std::size_t split(std::span<LitTexel> texels, std::size_t residue) {
  if (texels.size() <= residue) return texels.size();
  const Before before{widest_axis(texels)};
  constexpr std::size_t kSorted = 32;
  if (texels.size() <= kSorted) {
    std::sort(texels.begin(), texels.end(), before);
    return best_of_sorted(texels, before.axis, residue);
  }
  const std::size_t count = aligned(best_of_bins(texels, before.axis), residue);
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
  explicit Splitter(std::vector<LitTexel>& texels) : texels_(texels), splits_(inner_nodes(count())) {}

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
    return begin + static_cast<std::uint32_t>(split(part, residue));
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

// Root mean square distance of the texels' positions from their mean, m.
double position_spread(const std::vector<LitTexel>& texels) {
  std::array<Sums, 3> position;
  for (const LitTexel& texel : texels)
    for (std::size_t axis = 0; axis < 3; ++axis)
      position[axis].add(static_cast<double>(texel.feature[axis] - texels.front().feature[axis]));
  const double spread = position[0].spread() + position[1].spread() + position[2].spread();
  return std::sqrt(std::max(spread, 0.0) / static_cast<double>(texels.size()));
}

// Makes positions and normals comparable, and counts them in steps from the least of each, so that a scene
// that is moved or scaled has the same features but for a few that rounding takes to the next step.
void count_features(std::vector<LitTexel>& texels) {
  const double distance = position_spread(texels);
  if (!(distance > 0)) return;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const auto value = [axis](const LitTexel& texel) { return texel.feature[axis]; };
    const double least = std::ranges::min(texels, {}, value).feature[axis];
    const double steps = (axis < 3 ? 1 / distance : kNormalScale) / kStep;
    for (LitTexel& texel : texels)
      texel.feature[axis] =
          static_cast<float>(std::round((static_cast<double>(texel.feature[axis]) - least) * steps));
  }
}

// Between the geometric normal, which tells surfaces apart, and under a specular lobe that of shading.
interop::vec3 split_normal(const interop::Moments& moments, const interop::Surface& surface) {
  if (surface.ndf == interop::NDF_NONE) return moments.normal_mean;
  const Vec3 geometric = to_double(moments.normal_mean);
  return to_float(geometric + kBumps * (to_double(surface.shading_normal) - geometric));
}

}  // namespace

std::vector<LitTexel> lit_texels(const Rsm& rsm) {
  const auto texels = static_cast<std::uint32_t>(rsm.size) * static_cast<std::uint32_t>(rsm.size);
  std::vector<LitTexel> lit;
  for (std::uint32_t layer = 0; layer < rsm.layers.size(); ++layer)
    for (std::uint32_t texel = 0; texel < texels; ++texel) {
      const interop::Moments& moments = rsm.layers[layer].pyramid[texel];
      if (!(moments.weight > 0)) continue;
      const interop::Surface& surface = rsm.layers[layer].surface[texel];
      const interop::vec3 &y = moments.position, n = split_normal(moments, surface);
      lit.push_back({.feature = {y.x, y.y, y.z, n.x, n.y, n.z}, .index = layer * texels + texel});
    }
  if (!lit.empty()) count_features(lit);
  return lit;
}

TexelTree split_texels(std::vector<LitTexel> texels) {
  const std::vector<Split> splits = Splitter(texels).run();
  return lay_out(std::move(texels), splits);
}

}  // namespace vsgl
