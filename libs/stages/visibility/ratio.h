#pragma once

#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// The cut of a light tree, chosen without shadows, and the visible share of each pixel's light, estimated by
// a few rays and smoothed along surfaces.
Visibility estimate_ratio(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device* device,
                          Report& report);

}  // namespace vsgl::visibility
