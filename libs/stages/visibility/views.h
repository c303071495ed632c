#pragma once

#include "artifact/artifact.h"
#include "interop/splat.h"

namespace vsgl::visibility {

// From where a light's shadow map is seen.
// A hemisphere about the mean normal holds all that a flat cluster emits, diffuse and specular. It starts at
// the light's representative surface point, not at its mean position, which may lie inside a solid; lifted
// off the surface, and blind nearby, so that the cluster does not shadow itself. `disk_radius` (m) is that of
// the points that will be splatted.
interop::SplatView make_view(const interop::Light& light, double scene_radius, double disk_radius);

// Clusters whose mean normal is shorter than this (normals spread over more than about 53 degrees) emit
// outside any one hemisphere; they get one nevertheless, and are counted.
inline constexpr double curved_mean_normal = 0.6;
bool is_curved(const interop::Light& light);
// Whether the representative point is more than two standard deviations from the cluster's mean position.
bool is_off_centre(const interop::Light& light);
bool has_power(const interop::Light& light);

}  // namespace vsgl::visibility
