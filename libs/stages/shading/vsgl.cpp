#include <cstdint>

#include "spirv/shading/vsgl.comp.glsl.h"  // after <cstdint>, which it needs
#include "stages/shading/light_pack.h"
#include "stages/shading/methods.h"
#include "stages/shading/pass.h"

namespace vsgl {

Indirect shade_vsgl(const GBuffer& gbuffer, const Lights& lights, const Visibility* visibility,
                    const ShadingParams& params, gpu::Device& device, Report& report) {
  if (lights.kind == LightsKind::environment)
    return shade_environment(gbuffer, lights, visibility, params, device, report);
  return shade_sg({vsgl_comp_spv, pack_vsgl(lights)}, gbuffer, visibility, params, device, report);
}

}  // namespace vsgl
