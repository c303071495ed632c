#pragma once

#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// [Barak 2013] imperfect shadow maps whose points are made for each light on the device, from a subdivision
// of the triangles: none are stored.
Visibility build_tessellated(const VisibilityInputs& inputs, const VisibilityParams& params,
                             gpu::Device* device, Report& report);

}  // namespace vsgl::visibility
