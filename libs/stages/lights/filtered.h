#pragma once

#include <span>

#include "interop/sampling.h"
#include "stages/lights/lights.h"

namespace vsgl {

// What the methods of filtered importance sampling share: kernels by `rule` (KERNEL_* of interop/sampling.h),
// the moments under them, and the sampled texel as the surface point that represents the light. One light per
// sample.
std::vector<interop::Light> sample_lights(const Rsm& rsm, const Pdf& pdf, const LightsParams& params,
                                          std::uint32_t rule, gpu::Device& device, Report& report);

// The lights of given kernels, in their order, represented by the texels under the kernels' centres.
std::vector<interop::Light> filter_lights(const Rsm& rsm, std::span<const interop::Kernel> kernels,
                                          gpu::Device& device, Report& report);

}  // namespace vsgl
