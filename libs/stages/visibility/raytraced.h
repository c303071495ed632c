#pragma once

#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// Exact: a ray from each pixel to the surface point that represents each light.
Visibility trace_visibility(const VisibilityInputs& inputs, const VisibilityParams& params,
                            gpu::Device* device, Report& report);

}  // namespace vsgl::visibility
