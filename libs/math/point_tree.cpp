#include "math/point_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace vsgl {
namespace {

constexpr std::size_t kLeaf = 8;  // points that are searched one by one

double coordinate(Vec3 p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

}  // namespace

// The k smallest squared distances so far, in ascending order.
struct PointTree::Nearest {
  std::size_t k;
  std::vector<double> distances2;

  double bound() const {
    return distances2.size() < k ? std::numeric_limits<double>::infinity() : distances2.back();
  }
  void add(double distance2) {
    if (distance2 >= bound()) return;
    if (distances2.size() == k) distances2.pop_back();
    distances2.insert(std::upper_bound(distances2.begin(), distances2.end(), distance2), distance2);
  }
};

PointTree::PointTree(std::span<const Vec3> points)
    : points_(points), order_(points.size()), axis_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  build(0, order_.size());
}

void PointTree::build(std::size_t first, std::size_t last) {
  if (last - first <= kLeaf) return;
  Vec3 low = points_[order_[first]], high = low;
  for (std::size_t i = first; i < last; ++i) {
    const Vec3 p = points_[order_[i]];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t median = (first + last) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(median), at(last), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(coordinate(points_[a], axis), a) < std::pair(coordinate(points_[b], axis), b);
  });
  axis_[median] = static_cast<std::uint8_t>(axis);
  build(first, median);
  build(median + 1, last);
}

void PointTree::search(std::size_t first, std::size_t last, std::uint32_t self, Nearest& nearest) const {
  const auto visit = [&](std::uint32_t other) {
    const Vec3 v = points_[other] - points_[self];
    if (other != self) nearest.add(dot(v, v));
  };
  if (last - first <= kLeaf) {
    for (std::size_t i = first; i < last; ++i) visit(order_[i]);
    return;
  }
  const std::size_t median = (first + last) / 2;
  const int axis = axis_[median];
  const double beyond = coordinate(points_[self], axis) - coordinate(points_[order_[median]], axis);
  visit(order_[median]);
  const bool below = beyond < 0;
  search(below ? first : median + 1, below ? median : last, self, nearest);
  if (beyond * beyond < nearest.bound())
    search(below ? median + 1 : first, below ? last : median, self, nearest);
}

double PointTree::neighbour_distance2(std::uint32_t self, int k) const {
  Nearest nearest{static_cast<std::size_t>(k), {}};
  search(0, order_.size(), self, nearest);
  return nearest.distances2.empty() ? std::numeric_limits<double>::infinity() : nearest.distances2.back();
}

}  // namespace vsgl
