#pragma once

// One function per light model, see light_models(), and the schedule that needs more than a list of lights.

#include <string>

#include "stages/shading/shading.h"

namespace vsgl {

Indirect shade_fvpl(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&, gpu::Device&,
                    Report&);
Indirect shade_vpl(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&, gpu::Device&,
                   Report&);
Indirect shade_vsgl(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&, gpu::Device&,
                    Report&);
Indirect shade_vsgl_2014(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&, gpu::Device&,
                         Report&);

Indirect shade_vsl(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&, gpu::Device&,
                   Report&);

// Model vsgl with lights of an environment.
Indirect shade_environment(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&,
                           gpu::Device&, Report&);

// By a cut through a light tree: its clusters as filtered virtual point lights, with the cut's visibility.
// Also fills cut_size and error_estimate. The cut must be of these lights and of this image.
Indirect shade_cut(const GBuffer&, const Lights&, const Cut&, const ShadingParams&, gpu::Device&, Report&);

// The row of specular_lobes() that is asked for. Throws bad_value.
const SpecularLobe& find_specular_lobe(const ShadingParams& params);
// Throws bad_value where a lobe is asked for that the light model or the schedule leaves no choice of.
void require_specular_lobe(const LightModel& model, const std::string& schedule, const ShadingParams& params);

// Throws invalid_data, naming `what`, when it has another anchor than the G-buffer.
void require_same_anchor(const std::string& what, Vec3 anchor, const GBuffer& gbuffer);

}  // namespace vsgl
