#include <cstdint>

#include "cluster/cluster.h"
#include "spirv/shading/fvpl.comp.glsl.h"  // after <cstdint>, which it needs
#include "stages/shading/methods.h"
#include "stages/shading/pass.h"

namespace vsgl {

Indirect shade_fvpl(const GBuffer& gbuffer, const Lights& lights, const Visibility* visibility,
                    const ShadingParams& params, gpu::Device& device, Report& report) {
  ShadingKernel kernel{fvpl_comp_spv, pack_clusters(lights)};
  kernel.lobe = find_specular_lobe(params).kind;
  return compose(gbuffer, run_shading(gbuffer, visibility, kernel, params, device, report), !params.skip);
}

}  // namespace vsgl
