#pragma once

// The driver that all light models share: sorts pixels and lights into classes and sums the lights by one of
// the schedules of lists.

#include <span>
#include <vector>

#include "artifact/artifact.h"
#include "base/report.h"
#include "gpu/device.h"
#include "interop/shading.h"
#include "stages/shading/packed_lights.h"
#include "stages/shading/shading.h"

namespace vsgl {

struct ShadingKernel {
  std::span<const std::uint32_t> spirv;
  PackedLights lights;
  float threshold = 0;  // a_cbr; 0: no bias reduction
  std::uint32_t lobe = interop::SPECULAR_LOBE_AUTO;
  float clamp_distance2 = 0;  // m^2
  interop::VslSampling vsl{};
  // Of a kernel whose loop over lights is long: pixels an invocation and dispatch; 0: what suits the others.
  std::uint32_t pixels = 0;
  std::size_t receivers = 0;
};

// Sums of each pixel of the G-buffer; zero where nothing is seen. `visibility` may be null.
std::vector<interop::ShadingSums> run_shading(const GBuffer& gbuffer, const Visibility* visibility,
                                              const ShadingKernel& kernel, const ShadingParams& params,
                                              gpu::Device& device, Report& report);

// Reflectance times the sums. Specular stays empty where the G-buffer has no specular pixel, unless `all`.
Indirect compose(const GBuffer& gbuffer, const std::vector<interop::ShadingSums>& sums, bool all);
// Luminance of the pixel's indirect light.
double pixel_luminance(const Indirect& image, std::size_t pixel);

// A VSGL model: runs `kernel` (shader and lights given) with the parameters and fills all layers but the
// direct light.
Indirect shade_sg(ShadingKernel kernel, const GBuffer& gbuffer, const Visibility* visibility,
                  const ShadingParams& params, gpu::Device& device, Report& report);

}  // namespace vsgl
