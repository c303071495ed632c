#include <cstdint>
#include <span>

#include "spirv/pdf/brsm_vsgl.comp.glsl.h"
#include "stages/pdf/importance.h"
#include "stages/pdf/importons.h"
#include "stages/pdf/methods.h"

namespace vsgl {

// [Tokuyoshi 2014; Tokuyoshi 2016, section 5] light that each texel sends to the lights on the G-buffer.
TexelValues brsm_vsgl_values(const Rsm& rsm, const GBuffer* gbuffer, const PdfParams& params,
                             gpu::Device& device, Report& report) {
  const std::vector<interop::Importon> importons = make_importons(*gbuffer, params, device, report);
  report.count("gbuffer_lights", importons.size());
  ImportanceKernel kernel;
  kernel.spirv = brsm_vsgl_comp_spv;
  kernel.sources = std::as_bytes(std::span(importons));
  kernel.source_bytes = sizeof(interop::Importon);
  kernel.source_ndf = common_ndf(*gbuffer, params.skip);
  return sum_importance(rsm, kernel, params.skip, device, report);
}

}  // namespace vsgl
