#pragma once

#include <cstdint>
#include <vector>

#include "interop/splat.h"
#include "scene/scene.h"

namespace vsgl::visibility {

// Points spread evenly over all surfaces of a scene. Every run of consecutive points is stratified by area,
// so that each light takes a run of its own.
struct PointPool {
  std::vector<interop::SplatPoint> points;
  double area = 0;         // of all triangles, m^2
  double disk_radius = 0;  // of a point when `points_per_light` of them tile the area, m
  std::size_t holes = 0;   // points in the transparent part of a cut-out
};

// At most this many points are made; lights further on share those of the first ones.
inline constexpr std::size_t max_pool_size = std::size_t{1} << 20;

// Throws mesh_invalid when the scene has no area.
PointPool sample_points(const scene::Scene& scene, std::size_t light_count, int points_per_light,
                        std::uint64_t seed);

}  // namespace vsgl::visibility
