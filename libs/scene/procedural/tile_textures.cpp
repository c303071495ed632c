#include "scene/procedural/tile_textures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "math/srgb.h"
#include "scene/image_codec.h"

namespace vsgl::scene {
namespace {

constexpr int side = 512;

// SplitMix64 as a stateless hash: a number in [0, 1) for each seed and pair of integers.
double random(std::uint64_t seed, int x, int y) {
  std::uint64_t z = seed * 0x9E3779B97F4A7C15u + static_cast<std::uint32_t>(x) * 0xD1B54A32D192ED03u +
                    static_cast<std::uint32_t>(y) * 0x8CB92BA72F3D8DD7u + 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-53;
}

double smooth(double t) {
  return t * t * (3 - 2 * t);
}

// Seamless value noise of `cells` lattice cells a side, in [0, 1).
double noise(std::uint64_t seed, double u, double v, int cells) {
  const double x = u * cells, y = v * cells;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const auto lattice = [&](int a, int b) { return random(seed, a % cells, b % cells); };
  const double fx = smooth(x - i), fy = smooth(y - j);
  return std::lerp(std::lerp(lattice(i, j), lattice(i + 1, j), fx),
                   std::lerp(lattice(i, j + 1), lattice(i + 1, j + 1), fx), fy);
}

struct Place {
  int column, row;
  double edge;  // distance to the nearest edge of the tile, in tiles
};

Place place(const TilePattern& pattern, double u, double v) {
  const double y = v * pattern.rows;
  const int row = static_cast<int>(y);
  double x = u * pattern.columns + (pattern.bricks && row % 2 == 1 ? 0.5 : 0);
  const int column = static_cast<int>(x) % pattern.columns;
  x -= std::floor(x);
  const double fy = y - row;
  const double aspect = static_cast<double>(pattern.rows) / pattern.columns;  // joints equally wide both ways
  return {column, row, std::min(std::min(x, 1 - x) * aspect, std::min(fy, 1 - fy))};
}

// 0 in the joint, 1 on the tile, with a rounded bevel between.
double height(const TilePattern& pattern, double u, double v) {
  const double edge = place(pattern, u, v).edge / pattern.joint;
  const double roughness =
      0.12 * noise(pattern.seed + 1, u, v, 32) + 0.06 * noise(pattern.seed + 2, u, v, 96);
  return smooth(std::clamp(edge - 0.5, 0.0, 1.0)) + roughness;
}

std::uint8_t byte(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
}

// A picture whose pixel (u, v) at its centre is `colour(u, v)`.
template <typename Colour>
std::string paint(Colour colour) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(std::size_t{3} * side * side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const Vec3 value = colour((x + 0.5) / side, (y + 0.5) / side);
      for (const double component : to_array(value)) rgb.push_back(byte(component));
    }
  return image_codec().encode_png(side, side, rgb);
}

}  // namespace

std::string tile_colour_png(const TilePattern& pattern) {
  return paint([&](double u, double v) {
    const Place at = place(pattern, u, v);
    const double tile = 1 + pattern.variation * (2 * random(pattern.seed, at.column, at.row) - 1);
    const double grain = 1 + 0.1 * (noise(pattern.seed + 3, u, v, 64) - 0.5);
    const double joint = at.edge < pattern.joint / 2 ? 0.55 : 1;
    const Vec3 linear = pattern.colour * (tile * grain * joint);
    return Vec3{srgb_encode(linear.x), srgb_encode(linear.y), srgb_encode(linear.z)};
  });
}

std::string tile_normal_png(const TilePattern& pattern) {
  std::vector<double> heights(std::size_t{side} * side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      heights[y * side + x] = height(pattern, (x + 0.5) / side, (y + 0.5) / side);
  const auto at = [&](int x, int y) { return heights[(y + side) % side * side + (x + side) % side]; };
  const double scale = 5 * pattern.relief;
  return paint([&](double u, double v) {
    const int x = static_cast<int>(u * side), y = static_cast<int>(v * side);
    const double du = at(x + 1, y) - at(x - 1, y), dv = at(x, y + 1) - at(x, y - 1);  // rows count downwards
    return (normalise({-scale * du, scale * dv, 1}) + Vec3{1, 1, 1}) * 0.5;
  });
}

}  // namespace vsgl::scene
