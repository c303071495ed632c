#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/vec.h"

namespace vsgl {

// A k-d tree over points, for distances to nearest neighbours. `points` must outlive it.
class PointTree {
 public:
  explicit PointTree(std::span<const Vec3> points);

  // Squared distance from point `self` to the k-th nearest of the others (k >= 1), to the furthest of them
  // where there are fewer; infinite where there is none. Points in the same place count one by one.
  double neighbour_distance2(std::uint32_t self, int k) const;

 private:
  struct Nearest;
  void build(std::size_t first, std::size_t last);
  void search(std::size_t first, std::size_t last, std::uint32_t self, Nearest& nearest) const;

  std::span<const Vec3> points_;
  std::vector<std::uint32_t> order_;  // a median lies between those before and those after it
  std::vector<std::uint8_t> axis_;    // along which the median at this place divides
};

}  // namespace vsgl
