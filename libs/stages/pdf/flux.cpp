#include "stages/pdf/methods.h"
#include "stages/pdf/texels.h"

namespace vsgl {

// [Dachsbacher 2006] in proportion to the luminance of the reflected power: all virtual point lights are
// equally bright.
TexelValues flux_values(const Rsm& rsm, const GBuffer*, const PdfParams&, gpu::Device&, Report&) {
  return for_each_texel(rsm, [](const interop::Moments& m) { return static_cast<double>(m.weight); });
}

}  // namespace vsgl
