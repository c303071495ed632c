#pragma once

#include <cstddef>

namespace vsgl {

// Mip pyramids of square power-of-two images, level 0 = finest, stored one after another; level l is (size >>
// l)^2.
constexpr int pyramid_levels(int size) {
  int levels = 1;
  while (size >> levels) ++levels;
  return levels;
}
constexpr std::size_t pyramid_offset(int size, int level) {
  std::size_t offset = 0;
  for (int l = 0; l < level; ++l)
    offset += static_cast<std::size_t>(size >> l) * static_cast<std::size_t>(size >> l);
  return offset;
}
constexpr std::size_t pyramid_texels(int size) {
  return pyramid_offset(size, pyramid_levels(size));
}
constexpr bool is_power_of_two(int n) {
  return n > 0 && (n & (n - 1)) == 0;
}
constexpr int next_power_of_two(int n) {
  int p = 1;
  while (p < n) p *= 2;
  return p;
}

}  // namespace vsgl
