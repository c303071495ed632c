#pragma once

// One function per method; see pdf_methods().

#include "stages/pdf/pdf.h"

namespace vsgl {

TexelValues uniform_values(const Rsm&, const GBuffer*, const PdfParams&, gpu::Device&, Report&);
TexelValues flux_values(const Rsm&, const GBuffer*, const PdfParams&, gpu::Device&, Report&);
TexelValues brsm_vpl_values(const Rsm&, const GBuffer*, const PdfParams&, gpu::Device&, Report&);
TexelValues brsm_vsgl_values(const Rsm&, const GBuffer*, const PdfParams&, gpu::Device&, Report&);

}  // namespace vsgl
