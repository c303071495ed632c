#include "math/subdivision.h"

#include <cmath>

namespace vsgl {

std::uint32_t integer_root(std::uint32_t x) {
  return static_cast<std::uint32_t>(std::sqrt(static_cast<double>(x)));  // exact: 53 bits hold x
}

Vec3 subdivision_point(std::uint32_t k, std::uint32_t cell, Vec2 b) {
  const std::uint32_t row = integer_root(cell), place = cell - row * row, column = place / 2;
  const bool upright = place % 2 == 0;
  // In sides of a cell: the steps from corner 0 towards corners 1 and 2.
  const double first = row - column + (upright ? b.x : -b.x);
  const double second = column + (upright ? b.y : b.x + b.y);
  return {1 - (first + second) / k, first / k, second / k};
}

}  // namespace vsgl
