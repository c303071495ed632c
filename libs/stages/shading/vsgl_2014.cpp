#include <cstdint>

#include "spirv/shading/vsgl_2014.comp.glsl.h"  // after <cstdint>, which it needs
#include "stages/shading/light_pack.h"
#include "stages/shading/methods.h"
#include "stages/shading/pass.h"

namespace vsgl {

Indirect shade_vsgl_2014(const GBuffer& gbuffer, const Lights& lights, const Visibility* visibility,
                         const ShadingParams& params, gpu::Device& device, Report& report) {
  return shade_sg({vsgl_2014_comp_spv, pack_vsgl_2014(lights)}, gbuffer, visibility, params, device, report);
}

}  // namespace vsgl
