#pragma once

#include "math/vec.h"

namespace vsgl {

// Orthonormal, right-handed, z = the given direction.
struct Frame {
  Vec3 x, y, z;
  Vec3 to_world(Vec3 local) const { return local.x * x + local.y * y + local.z * z; }
  Vec3 to_local(Vec3 world) const { return {dot(world, x), dot(world, y), dot(world, z)}; }
};

// The twin of shaders/lib/frame.glsl, where the source is named.
inline Frame frame_about(Vec3 n) {
  const double s = n.z < -0.61 ? -1 : 1;
  const double a = -1 / (s + n.z), b = n.x * n.y * a;
  return {{1 + s * n.x * n.x * a, s * b, -s * n.x}, {b, s + n.y * n.y * a, -n.y}, n};
}

}  // namespace vsgl
