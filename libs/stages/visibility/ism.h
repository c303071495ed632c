#pragma once

#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// [Ritschel 2008] imperfect shadow maps: every light sees its own share of a pool of surface points, splatted
// as small squares into a hemi-octahedral map; the holes between them are closed by pull-push.
ShadowMaps render_shadow_maps(const scene::Scene& scene, const Lights& lights, const VisibilityParams& params,
                              gpu::Device& device, Report& report);
Visibility build_ism(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device* device,
                     Report& report);

}  // namespace vsgl::visibility
