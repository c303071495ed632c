#pragma once

#include "math/vec.h"

namespace vsgl::sh {

// A sphere relative to a receiver.
struct SeenSphere {
  Vec3 center;
  double radius = 0;  // 0: nothing is seen of it
};

// [Ren 2006, Section 5] replacement rules for self-shadowing: what stands for a sphere that reaches below the
// tangent plane of a receiver with that normal, so that a surface is not hidden by the spheres that
// approximate it.
SeenSphere above_plane(SeenSphere sphere, Vec3 normal);

}  // namespace vsgl::sh
