#pragma once

#include <cmath>

#include "../synthetic_scene.h"

namespace vsgl::test {

inline const Vec3 room_low{-1, -1, 0}, room_high{1, 1, 2};

// An empty box, seen from inside.
inline scene::Scene room() {
  scene::Scene scene;
  scene.radius = std::sqrt(6.0);
  add_box(scene, room_low, room_high);
  return scene;
}

}  // namespace vsgl::test
