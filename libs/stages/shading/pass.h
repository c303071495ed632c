#pragma once

// The driver that all shading methods share: sorts pixels and lights into classes, builds one specialised
// pipeline per pair of classes that occurs, and sums the lights block by block.

#include <span>
#include <vector>

#include "artifact/artifact.h"
#include "base/report.h"
#include "gpu/device.h"
#include "interop/shading.h"
#include "stages/shading/shading.h"

namespace vsgl {

struct ShadingKernel {
  std::span<const std::uint32_t> spirv;
  std::vector<interop::ShadingLight> lights;  // in the order of the artifact
  float threshold = 0;                        // a_cbr; 0: no bias reduction
  bool asg = false;
  float clamp_distance2 = 0;  // m^2
  bool skip = true;
};

// Sums of each pixel of the G-buffer; zero where nothing is seen. `visibility` may be null.
std::vector<interop::ShadingSums> run_shading(const GBuffer& gbuffer, const Visibility* visibility,
                                              const ShadingKernel& kernel, gpu::Device& device,
                                              Report& report);

// Reflectance times the sums. Specular stays empty where the G-buffer has no specular pixel, unless `all`.
Indirect compose(const GBuffer& gbuffer, const std::vector<interop::ShadingSums>& sums, bool all);
// Luminance of the pixel's indirect light.
double pixel_luminance(const Indirect& image, std::size_t pixel);

// A VSGL method: runs `kernel` (shader and lights given) with the parameters and fills all layers but the
// direct light.
Indirect shade_sg(ShadingKernel kernel, const GBuffer& gbuffer, const Visibility* visibility,
                  const ShadingParams& params, gpu::Device& device, Report& report);

}  // namespace vsgl
