#include "base/error.h"
#include "stages/lights/filtered.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

// One kernel that holds just a texel, for each texel that reflects.
std::vector<interop::Kernel> texel_kernels(const Rsm& rsm) {
  std::vector<interop::Kernel> kernels;
  const auto size = static_cast<std::uint32_t>(rsm.size);
  const float side = 1 / static_cast<float>(rsm.size);
  for (std::uint32_t layer = 0; layer < rsm.layers.size(); ++layer)
    for (std::uint32_t texel = 0; texel < size * size; ++texel) {
      if (!(rsm.layers[layer].pyramid[texel].weight > 0)) continue;
      const interop::vec2 centre{(static_cast<float>(texel % size) + 0.5f) * side,
                                 (static_cast<float>(texel / size) + 0.5f) * side};
      kernels.push_back({.centre = centre, .level = 0, .power_scale = 1, .layer = layer, .texel = texel});
    }
  return kernels;
}

}  // namespace

// Every texel that reflects, with its own power, footprint and lobes: neither sampled nor filtered, what all
// other methods approximate.
LightSet generate_texels(const Rsm& rsm, const Pdf*, const LightsParams& params, gpu::Device* device,
                         Report& report) {
  report.skipped("sampling",
                 "method texels takes every texel that reflects: density, count, points and "
                 "kernels play no part");
  const auto kernels = texel_kernels(rsm);
  if (kernels.size() > interop::MAX_POINTS)
    throw Error(ErrorCode::out_of_range, "method texels: " + std::to_string(kernels.size()) +
                                             " texels reflect, more than " +
                                             std::to_string(interop::MAX_POINTS) + "; bake a smaller RSM");
  if (kernels.empty()) return {};
  return {filter_lights(rsm, kernels, params, *device, report), {}};
}

}  // namespace vsgl
