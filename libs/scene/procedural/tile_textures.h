#pragma once

#include <cstdint>
#include <string>

#include "math/vec.h"

namespace vsgl::scene {

// A seamless picture of bevelled tiles or bricks.
struct TilePattern {
  int columns = 4, rows = 4;
  bool bricks = false;      // every other row shifted by half a tile
  Vec3 colour;              // mean reflectance of a tile, linear
  double variation = 0.15;  // of the reflectance between tiles, relative
  double joint = 0.04;      // width of the joint, in tiles
  double relief = 0.6;      // height of a tile above the joint, in pixels times 10
  std::uint64_t seed = 0;
};

// PNG files of 512 x 512 pixels: base colour (sRGB), and tangent-space normals (green up). Equal patterns
// give equal bytes.
std::string tile_colour_png(const TilePattern& pattern);
std::string tile_normal_png(const TilePattern& pattern);

}  // namespace vsgl::scene
