#pragma once

#include <cstdint>

#include "math/octahedral.h"
#include "math/vec.h"

// Triangles cut into k^2 congruent cells by lines parallel to their sides: the twin of
// shaders/lib/subdivision.glsl.

namespace vsgl {

// floor(sqrt(x)).
std::uint32_t integer_root(std::uint32_t x);

// Barycentric coordinates in the triangle of the point that has (1 - b.x - b.y, b.x, b.y) in cell `cell` of
// k^2. Cells are numbered row by row from corner 0 on; row r has 2 r + 1 of them, those with odd places
// upside down.
Vec3 subdivision_point(std::uint32_t k, std::uint32_t cell, Vec2 b);

}  // namespace vsgl
