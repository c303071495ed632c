#pragma once

#include "math/vec.h"

// Hemi-octahedral map of the hemisphere z >= 0 to the square [-1, 1]^2: the twin of
// shaders/lib/octahedral.glsl.

namespace vsgl {

struct Vec2 {
  double x = 0, y = 0;
};

// `v`: any length, v.z >= 0, not zero.
Vec2 hemi_octahedral_encode(Vec3 v);
// Point of the octahedron |x| + |y| + z = 1 above the square's point, and its direction.
Vec3 hemi_octahedral_point(Vec2 e);
Vec3 hemi_octahedral_decode(Vec2 e);
// Solid angle (sr) of the texel centred at `e` in a map of `size` texels a side, by the midpoint rule.
double hemi_octahedral_solid_angle(Vec2 e, double size);

}  // namespace vsgl
