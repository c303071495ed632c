#pragma once

#include <span>

#include "pyramid/kernels.h"
#include "stages/lights/lights.h"

namespace vsgl {

// What the methods of filtered importance sampling share: kernels by `rule` (KERNEL_* of interop/sampling.h),
// the moments under them, and the sampled texel as the surface point that represents the light. One light per
// sample.
std::vector<interop::Light> sample_lights(const Rsm& rsm, const Pdf& pdf, const LightsParams& params,
                                          std::uint32_t rule, gpu::Device& device, Report& report);

// How fis-2016 sizes kernels, one of KERNEL_*.
std::uint32_t share_rule(const LightsParams& params);
KernelParams kernel_params(const LightsParams& params, std::uint32_t rule);
std::vector<DensityPyramid> densities_of(const Pdf& pdf);

// Unless the paper's powers are asked for: scales all powers by one factor, so that they add up to the RSM's.
void conserve_power(const Rsm& rsm, const LightsParams& params, std::vector<interop::Light>& lights,
                    Report& report);

// The lights of given kernels, in their order, represented by the texels under the kernels' centres.
std::vector<interop::Light> filter_lights(const Rsm& rsm, std::span<const interop::Kernel> kernels,
                                          const LightsParams& params, gpu::Device& device, Report& report);

// Makes the light's texel its representative. A cluster whose normals cancel takes the texel's normal.
void represent(interop::Light& light, const RsmLayer& layer);

}  // namespace vsgl
