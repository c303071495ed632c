#pragma once

#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// [Ritschel 2011] imperfect shadow maps whose points are denser where they may shadow what the camera sees.
Visibility build_aism(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device* device,
                      Report& report);

}  // namespace vsgl::visibility
