#pragma once

#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// [Ritschel 2008] imperfect shadow maps: every light sees its own share of a pool of surface points, splatted
// as small squares into a hemi-octahedral map; the holes between them are closed by pull-push.
Visibility build_ism(const scene::Scene& scene, const Lights& lights, const GBuffer* gbuffer,
                     const VisibilityParams& params, gpu::Device* device, Report& report);

}  // namespace vsgl::visibility
