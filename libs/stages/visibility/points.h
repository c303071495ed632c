#pragma once

#include <cstdint>
#include <vector>

#include "interop/splat.h"
#include "scene/scene.h"
#include "stages/visibility/patches.h"

namespace vsgl::visibility {

// Points on the surfaces of a scene. Every run of consecutive points is stratified by their density, so that
// each light takes a run of its own.
struct PointPool {
  std::vector<interop::SplatPoint> points;
  double area = 0;         // of all patches, m^2
  double disk_radius = 0;  // of a point when `points_per_light` equal disks tile the area, m
  std::size_t holes = 0;   // points in the transparent part of a cut-out
};

// At most this many points are made; lights further on share those of the first ones.
inline constexpr std::size_t max_pool_size = std::size_t{1} << 20;

// Each patch gets points in proportion to its weight (positive), and these share its area between them: where
// the weights are areas_of(patches), points are spread evenly over all surfaces.
PointPool sample_points(const scene::Scene& scene, const std::vector<Patch>& patches,
                        const std::vector<double>& weights, std::size_t light_count, int points_per_light,
                        std::uint64_t seed);

}  // namespace vsgl::visibility
