#include "stages/visibility/shadow_lookup.h"

#include <algorithm>
#include <cmath>

#include "math/frame.h"
#include "math/octahedral.h"

namespace vsgl {
namespace {

// Inverse distance that a light's map holds at a texel of its tile, clamped to the tile; 0: nothing there.
double inverse_distance(const ShadowMaps& maps, std::size_t light, int x, int y) {
  const auto columns = static_cast<std::size_t>(maps.columns), tile = static_cast<std::size_t>(maps.tile);
  const std::size_t row = light / columns * tile + std::clamp(y, 0, maps.tile - 1);
  const std::size_t column = light % columns * tile + std::clamp(x, 0, maps.tile - 1);
  return maps.inverse_distance[row * columns * tile + column];
}

// Of four neighbouring texels, each compared with the receiver's biased distance, interpolated at `place`
// (texels).
double filtered_comparison(const ShadowMaps& maps, std::size_t light, double place_x, double place_y,
                           double biased) {
  const double x = std::floor(place_x - 0.5), y = std::floor(place_y - 0.5);
  const double fx = place_x - 0.5 - x, fy = place_y - 0.5 - y;
  double visible = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double inverse = inverse_distance(maps, light, static_cast<int>(x) + i, static_cast<int>(y) + j);
      if (biased * inverse <= 1) visible += (i ? fx : 1 - fx) * (j ? fy : 1 - fy);
    }
  return visible;
}

}  // namespace

double shadow_visibility(const ShadowMaps& maps, std::size_t light, Vec3 receiver, Vec3 normal, bool filter) {
  const auto& view = maps.views[light];
  const Vec3 origin{view.origin.x, view.origin.y, view.origin.z}, axis{view.axis.x, view.axis.y, view.axis.z};
  const Vec3 v = receiver - origin;
  const double d = length(v);
  if (dot(v, axis) <= 0) return 0;
  const Frame frame = frame_about(axis);
  const double cosine = std::min(std::abs(dot(normal, v)) / d, 1.0);
  const double sine = std::sqrt(1 - cosine * cosine);
  const double texel_angle =
      std::sqrt(hemi_octahedral_solid_angle(hemi_octahedral_encode(frame.to_local(v)), maps.tile));

  Vec3 moved = v + normal * (maps.normal_offset * d * texel_angle * sine);
  const double tangent = std::min(sine / std::max(cosine, 1e-6), shadow_max_tangent);
  const double distance = length(moved);
  const double biased = distance * (1 - maps.relative_bias - maps.slope_bias * texel_angle * tangent) -
                        maps.bias_disk_radius / 4;
  if (dot(moved, axis) <= 0) return 0;
  const Vec2 e = hemi_octahedral_encode(frame.to_local(moved));
  const double x = (0.5 * e.x + 0.5) * maps.tile, y = (0.5 * e.y + 0.5) * maps.tile;
  if (filter) return filtered_comparison(maps, light, x, y, biased);
  return biased * inverse_distance(maps, light, static_cast<int>(x), static_cast<int>(y)) <= 1 ? 1 : 0;
}

}  // namespace vsgl
