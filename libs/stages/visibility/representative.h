#pragma once

#include "artifact/artifact.h"
#include "trace/tracer.h"

namespace vsgl::visibility {

// The light's representative surface point. A light's normal is the mean of its cluster; where that is not
// flat, the normal at the point itself is that of the surface which a ray from a little nearer to the source
// meets.
trace::SurfacePoint representative(const interop::Light& light, double scene_radius,
                                   const trace::Tracer& tracer);

}  // namespace vsgl::visibility
