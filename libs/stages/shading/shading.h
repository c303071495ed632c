#pragma once

// Shading: indirect radiance at every pixel of a G-buffer from virtual lights, and direct light from a
// reflective shadow map. docs/shading.md states the formulas.

#include <string>
#include <vector>

#include "artifact/artifact.h"
#include "base/report.h"
#include "gpu/device.h"

namespace vsgl {

struct ShadingParams {
  std::string method = "vsgl";  // one of shading_methods()
  double clamp = 0.01;          // vpl: floor of the distance, as a fraction of the scene's radius; 0: none
  std::string specular_lobe =
      "auto";             // auto: the most accurate per NDF; asg: anisotropic SG, as the papers print it
  double cbr = 0.05;      // consistent bias reduction: threshold a_cbr, 0..1; 0: off
  int diffuse_scale = 2;  // cut: 2: diffuse light at half resolution where that suffices; 1: at every pixel
  bool skip = true;       // leave out what the scene does not need
};

// Radiance from `lights` at every pixel of `gbuffer`. `visibility`: of these lights; null: no shadows. The
// same inputs give the same bytes for any number of threads. Throws bad_value for an unknown method or lobe,
// out_of_range, wrong_size when `visibility` has another number of lights or
// pixels, invalid_data when the inputs' anchors
// differ, device_limit.
Indirect shade(const GBuffer& gbuffer, const Lights& lights, const Visibility* visibility,
               const ShadingParams& params, gpu::Device& device, Report& report);

// Fills `out.direct`: radiance that the light sources of `rsm` cause at first hand, shadowed by the depths of
// its layers.
void shade_direct(const GBuffer& gbuffer, const Rsm& rsm, gpu::Device& device, Report& report, Indirect& out);

struct ShadingMethod {
  std::string name;
  std::string summary;
  Indirect (*run)(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&, gpu::Device&,
                  Report&);
};
const std::vector<ShadingMethod>& shading_methods();

}  // namespace vsgl
