#pragma once

#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// The cut of a light tree, chosen with the visibility that rays find, and which pixels see its nodes.
Visibility trace_cut(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device* device,
                     Report& report);

}  // namespace vsgl::visibility
