#include "stages/pdf/methods.h"
#include "stages/pdf/texels.h"

namespace vsgl {

// Every texel that reflects light is as likely as any other.
TexelValues uniform_values(const Rsm& rsm, const GBuffer*, const PdfParams&, gpu::Device&, Report&) {
  return for_each_texel(rsm, [](const interop::Moments& m) { return m.weight > 0 ? 1.0 : 0.0; });
}

}  // namespace vsgl
