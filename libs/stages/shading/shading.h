#pragma once

// Shading: indirect radiance at every pixel of a G-buffer from virtual lights, and direct light from a
// reflective shadow map. docs/shading.md states the formulas.

#include <string>
#include <vector>

#include "artifact/artifact.h"
#include "base/pass.h"
#include "base/report.h"
#include "gpu/device.h"

namespace vsgl {

struct ShadingParams {
  std::string light_model = "fvpl";  // one of light_models()
  std::string schedule = "auto";     // auto | flat | interleave | cut: see resolve_schedule()
  int interleave = 4;  // of interleave: pixels a side of the pattern; 1, 2, 4 or 8, 1 is flat
  double clamp = 0.01;  // vpl: floor of the distance, as a fraction of the scene's radius; 0: none
  std::string specular_lobe = "auto";  // one of specular_lobes()
  double cbr = 0.05;      // consistent bias reduction: threshold a_cbr, 0..1; 0: off
  int diffuse_scale = 2;  // cut: 2: diffuse light at half resolution where that suffices; 1: at every pixel
  int vsl_samples = 32;   // vsl: directions a technique draws in a hemisphere, 1..4096; narrower cones take fewer
  std::string vsl_cone = "disk";       // vsl: disk | sphere
  std::string vsl_techniques = "all";  // vsl: all | cone | receiver | light: where directions are drawn from
  std::uint64_t seed = 0;              // vsl: of the directions
  Pass pass{};                           // vsl: other directions in each; vpl: a smaller floor of the distance
  bool skip = true;       // leave out what the scene does not need
};

// How the lights are summed: "cut" (only what each tile needs) where they are a tree; for lists "flat" (all
// lights at every pixel), unless "interleave" (a share of them at each pixel of a square) is asked for. Throws
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
  bool has_lobe = false;     // reflects light by a specular lobe of choice
};
const std::vector<LightModel>& light_models();

// How the receiver's specular lobe is multiplied with a light's spherical Gaussian.
struct SpecularLobe {
  std::string name;
  std::string summary;
  std::uint32_t kind;  // interop::SPECULAR_LOBE_*
};
const std::vector<SpecularLobe>& specular_lobes();

}  // namespace vsgl
