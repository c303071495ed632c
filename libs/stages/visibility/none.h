#pragma once

#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// Nothing casts a shadow: of a list Unshadowed, of a tree a cut whose entries all pixels see.
Visibility build_none(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device* device,
                      Report& report);

}  // namespace vsgl::visibility
