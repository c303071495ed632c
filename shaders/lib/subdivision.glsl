// Triangles cut into k^2 congruent cells by lines parallel to their sides. Twin: libs/math/subdivision.h.
#ifndef VSGL_LIB_SUBDIVISION_GLSL
#define VSGL_LIB_SUBDIVISION_GLSL

// floor(sqrt(x)), exactly, for x < 2^32.
uint integer_root(uint x) {
  uint root = min(uint(sqrt(float(x))), 65535u);
  while (root * root > x) --root;
  while (root < 65535u && (root + 1u) * (root + 1u) <= x) ++root;
  return root;
}

// Barycentric coordinates in the triangle of the point that has (1 - b.x - b.y, b.x, b.y) in a cell. Cells are
// numbered row by row from corner 0 on; row r has 2 r + 1 of them, those with odd places upside down.
vec3 subdivision_point(uint k, uint cell, vec2 b) {
  uint row = integer_root(cell), place = cell - row * row, column = place / 2u;
  bool upright = place % 2u == 0u;
  // In sides of a cell: the steps from corner 0 towards corners 1 and 2.
  vec2 steps = vec2(row - column, column) + (upright ? b : vec2(-b.x, b.x + b.y));
  steps /= float(k);
  return vec3(1.0 - steps.x - steps.y, steps);
}

#endif
