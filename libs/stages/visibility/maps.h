#pragma once

#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// The cut of a light tree, chosen with the visibility that imperfect shadow maps of one level's nodes give,
// and which pixels see its nodes: for scenes and machines on which rays cannot be traced.
Visibility map_cut(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device* device,
                   Report& report);

}  // namespace vsgl::visibility
