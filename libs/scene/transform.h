#pragma once

#include <array>

#include "math/vec.h"

namespace vsgl::scene {

Mat4 translation(Vec3 offset);
Mat4 scaling(Vec3 factors);
// Rotation by a unit quaternion (x, y, z, w); the caller normalises.
Mat4 rotation(const std::array<double, 4>& quaternion);
// About x first, then y, then z, all fixed axes; angles in degrees.
Mat4 rotation_xyz_deg(Vec3 angles);

// outer * inner. Where translations cancel, only digits that both of them have are kept: what remains of two
// large ones does not depend on how these were rounded.
Mat4 compose(const Mat4& outer, const Mat4& inner);

// Of the upper left 3x3 block.
double determinant(const Mat4& m);
// The inverse transpose of the upper left 3x3 block times |determinant|: takes normals to the right side,
// also under mirroring transforms. Not normalised.
Vec3 transform_normal(const Mat4& m, Vec3 normal);

bool is_finite(const Mat4& m);
inline bool is_finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace vsgl::scene
