#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/strict_json.h"
#include "math/vec.h"

namespace vsgl::scene {

// A sphere that sends the same radiance from everywhere in all directions. It hides nothing and is not seen
// itself; it lights surfaces at first hand alone.
struct SphereLight {
  std::string name;
  Vec3 position;           // relative to the anchor, m
  double radius = 1;       // m
  Vec3 radiance{1, 1, 1};  // W/(m^2 sr)
};

// The entries of "sphere_lights" in a scene JSON; none where it has none. Throws json_*.
std::vector<SphereLight> read_sphere_lights(const JsonValue& root, Vec3 anchor);
// Those of a file, at least one. Throws json_*, file_not_found, bad_light.
std::vector<SphereLight> load_sphere_lights(const std::filesystem::path& json_path, Vec3 anchor);

}  // namespace vsgl::scene
