#pragma once

#include <vector>

#include "interop/importance.h"
#include "stages/pdf/pdf.h"

namespace vsgl {

// What brsm-vsgl shines on the texels: virtual spherical Gaussian lights on the image, made by
// params.gbuffer_generation. Their powers are right relative to one another. None where nothing reflects.
std::vector<interop::Importon> make_importons(const GBuffer& gbuffer, const PdfParams& params,
                                              gpu::Device& device, Report& report);

}  // namespace vsgl
