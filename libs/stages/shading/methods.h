#pragma once

// One function per method; see shading_methods().

#include "stages/shading/shading.h"

namespace vsgl {

Indirect shade_vpl(const GBuffer&, const Lights&, const ShadowMaps*, const ShadingParams&, gpu::Device&, Report&);
Indirect shade_vsgl(const GBuffer&, const Lights&, const ShadowMaps*, const ShadingParams&, gpu::Device&, Report&);
Indirect shade_vsgl_2014(const GBuffer&, const Lights&, const ShadowMaps*, const ShadingParams&, gpu::Device&, Report&);

}  // namespace vsgl
