#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "math/vec.h"

namespace vsgl::soft_gi {

// Unit vectors spread evenly over the sphere: Fibonacci's spiral.
inline std::vector<Vec3> directions(int count) {
  std::vector<Vec3> out;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z),
                 azimuth = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
    out.push_back({r * std::cos(azimuth), r * std::sin(azimuth), z});
  }
  return out;
}

}  // namespace vsgl::soft_gi
