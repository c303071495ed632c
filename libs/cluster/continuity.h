#pragma once

#include "interop/surface.h"

namespace vsgl {

// How well the surface at `sample` continues that at `pixel`, 0..1. The cosine of their normals counts to its
// 16th power. Below kContinues it is another surface.
double continuity(const interop::Surface& pixel, const interop::Surface& sample);
inline constexpr double kContinues = 0.2;

}  // namespace vsgl
