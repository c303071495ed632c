#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "math/vec.h"

namespace vsgl::scene {

// Where the light from infinitely far away comes from, as a scene JSON says it.
struct EnvironmentSpec {
  std::filesystem::path file;  // latitude-longitude map, OpenEXR or Radiance HDR
  Vec3 rotation_deg;           // of the map, about the world's x, then y, then z
  double scale = 1;            // radiance over the map's values, W/(m^2 sr)

  bool operator==(const EnvironmentSpec&) const = default;
};

// A latitude-longitude map: row 0 is at +y; the columns run from -z by +x, +z (the middle) and -x back to -z,
// so that from inside nothing is mirrored. These are OpenEXR's conventions for environment maps.
struct Environment {
  int width = 0, height = 0;   // width = 2 height
  std::vector<Vec3> radiance;  // W/(m^2 sr), row by row; finite, not negative, somewhere positive
  Mat4 rotation;               // from the map's directions to the world's

  const Vec3& at(int column, int row) const {
    return radiance[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(column)];
  }
};

// Throws file_not_found, texture_unreadable (no readable image), wrong_channel_type (8-bit images),
// missing_channel (not R, G, B), wrong_size (not twice as wide as high), non_finite, invalid_data (negative
// radiance, or more than 1e30), bad_light (black).
Environment read_environment(const EnvironmentSpec& spec);

// Unit direction, in the map's frame, to the point (u, v) of the map, 0..1 from its upper left corner.
Vec3 environment_direction(double u, double v);
// Radiance of the texel in a unit direction of the world: environment_direction turned round, after the
// map's rotation.
Vec3 radiance_from(const Environment& environment, Vec3 direction);

// What the texels of column `column` and row `row` cover: directions in the map's frame.
struct EnvironmentTexel {
  double solid_angle = 0;  // sr
  Vec3 mean;               // mean direction, exact; its length is 1 - O(size^2)
};
EnvironmentTexel environment_texel(const Environment& environment, int column, int row);

}  // namespace vsgl::scene
