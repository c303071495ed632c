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
  std::string light_model = "fvpl";  // one of light_models()
  std::string schedule = "auto";     // auto | flat | interleave | cut: see resolve_schedule()
  double clamp = 0.01;  // vpl: floor of the distance, as a fraction of the scene's radius; 0: none
  std::string specular_lobe =
      "auto";             // auto: the most accurate per NDF; asg: anisotropic SG, as the papers print it
  double cbr = 0.05;      // consistent bias reduction: threshold a_cbr, 0..1; 0: off
  int diffuse_scale = 2;  // cut: 2: diffuse light at half resolution where that suffices; 1: at every pixel
  bool skip = true;       // leave out what the scene does not need
};

// How the lights are summed: "cut" (only what each tile needs) where they are a tree; for lists "flat" (all
// lights at every pixel), unless "interleave" (a sixteenth at each of 4x4 pixels) is asked for. Throws
// bad_value for an unknown schedule, and for one that these lights do not fit.
std::string resolve_schedule(const ShadingParams& params, const Lights& lights);

// Radiance from `lights` at every pixel of `gbuffer`. `visibility`: of these lights; null: no shadows; for a
// tree it is its cut. The same inputs give the same bytes for any number of threads. Throws bad_value for an
// unknown light model, schedule or lobe, and for those that do not fit the inputs, out_of_range, wrong_size
// when `visibility` has another number of lights or pixels, invalid_data when the inputs' anchors differ,
// device_limit.
Indirect shade(const GBuffer& gbuffer, const Lights& lights, const Visibility* visibility,
               const ShadingParams& params, gpu::Device& device, Report& report);

// Fills `out.direct`: radiance that the light sources of `rsm` cause at first hand, shadowed by the depths of
// its layers.
void shade_direct(const GBuffer& gbuffer, const Rsm& rsm, gpu::Device& device, Report& report, Indirect& out);

struct LightModel {
  std::string name;
  std::string summary;
  Indirect (*run)(const GBuffer&, const Lights&, const Visibility*, const ShadingParams&, gpu::Device&,
                  Report&);  // of a list of lights
};
const std::vector<LightModel>& light_models();

}  // namespace vsgl
