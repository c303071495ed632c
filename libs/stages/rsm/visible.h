#pragma once

#include <vector>

#include "interop/geometry.h"
#include "scene/scene.h"
#include "trace/tracer.h"

namespace vsgl {

// 1 + the triangle that each texel of the view sees through its centre, row by row; 0: nothing. Triangles
// count through all instances. What rasterising the view gives, but for texels whose centres lie on an edge
// within rounding. The same on any number of threads.
std::vector<interop::uint> trace_visible(const scene::Scene& scene, const trace::Tracer& tracer,
                                         const interop::View& view);

}  // namespace vsgl
