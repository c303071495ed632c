#pragma once

#include <cstddef>

#include "artifact/artifact.h"

namespace vsgl {

// Slope bias is proportional to the tangent of the angle of incidence, up to this.
inline constexpr double shadow_max_tangent = 1.5;

// The visibility of a receiver from a light according to its shadow map, in double precision: the oracle for
// shaders that look maps up. `receiver` in metres relative to the anchor, `normal` unit. 0 hidden (also
// behind the light's surface), 1 visible; in between only with `filter`: four neighbouring texels are
// compared and the outcomes interpolated.
double shadow_visibility(const ShadowMaps& maps, std::size_t light, Vec3 receiver, Vec3 normal,
                         bool filter = true);

}  // namespace vsgl
