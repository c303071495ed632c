#include <cstdint>

#include "spirv/shading/environment.comp.glsl.h"  // after <cstdint>, which it needs
#include "stages/shading/light_pack.h"
#include "stages/shading/methods.h"
#include "stages/shading/pass.h"

namespace vsgl {

Indirect shade_environment(const GBuffer& gbuffer, const Lights& lights, const Visibility* visibility,
                           const ShadingParams& params, gpu::Device& device, Report& report) {
  report.skipped("bias reduction", "the lights are infinitely far away");
  return shade_sg({environment_comp_spv, pack_environment(lights)}, gbuffer, visibility, params, device,
                  report);
}

}  // namespace vsgl
