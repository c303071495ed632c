#pragma once

#include <string>
#include <vector>

#include "math/vec.h"

namespace vsgl {
class JsonValue;
}

namespace vsgl::scene {

// A sphere that sends the same radiance from everywhere in all directions. It hides nothing and is not seen
// itself; it lights surfaces at first hand alone.
struct SphereLight {
  std::string name;
  Vec3 position;           // m
  double radius = 1;       // m
  Vec3 radiance{1, 1, 1};  // W/(m^2 sr)
};

// The entries of "sphere_lights" in a scene JSON, in world coordinates; none where it has none. Throws
// json_*.
std::vector<SphereLight> read_sphere_lights(const JsonValue& root);

}  // namespace vsgl::scene
