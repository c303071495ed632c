#include "math/octahedral.h"

namespace vsgl {

Vec2 hemi_octahedral_encode(Vec3 v) {
  const double norm = std::abs(v.x) + std::abs(v.y) + v.z;
  return {(v.x + v.y) / norm, (v.x - v.y) / norm};
}

Vec3 hemi_octahedral_point(Vec2 e) {
  const double x = (e.x + e.y) / 2, y = (e.x - e.y) / 2;
  return {x, y, 1 - std::abs(x) - std::abs(y)};
}

Vec3 hemi_octahedral_decode(Vec2 e) {
  return normalise(hemi_octahedral_point(e));
}

double hemi_octahedral_solid_angle(Vec2 e, double size) {
  const double area =
      4 / (size * size);  // of a texel; the octahedron's face has half of it as its measure in (x, y)
  const double r = length(hemi_octahedral_point(e));
  return area / (2 * r * r * r);
}

}  // namespace vsgl
