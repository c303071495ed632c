#pragma once

#include "stages/visibility/map_renderer.h"
#include "stages/visibility/points.h"

namespace vsgl::visibility {

// Light i takes `points_per_light` points of the pool from i * points_per_light on, wrapped around.
std::unique_ptr<PointSource> make_pool_source(const PointPool& pool, int points_per_light,
                                              gpu::Device& device, Report& report);

}  // namespace vsgl::visibility
