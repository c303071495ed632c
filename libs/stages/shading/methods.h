#pragma once

// One function per method; see shading_methods().

#include <string>

#include "stages/shading/shading.h"

namespace vsgl {

Indirect shade_vpl(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&, gpu::Device&,
                   Report&);
Indirect shade_vsgl(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&, gpu::Device&,
                    Report&);
Indirect shade_vsgl_2014(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&, gpu::Device&,
                         Report&);

// Throws invalid_data, naming `what`, when it has another anchor than the G-buffer.
void require_same_anchor(const std::string& what, Vec3 anchor, const GBuffer& gbuffer);

}  // namespace vsgl
