#include "stages/lights/filtered.h"
#include "stages/lights/methods.h"

namespace vsgl {

// [Keller 1997; Dachsbacher 2005] the sampled texel itself, of power M w / (N p): no filter, no footprint.
LightSet generate_vpl(const Rsm& rsm, const Pdf* pdf, const LightsParams& params, gpu::Device* device,
                      Report& report) {
  auto lights = sample_lights(rsm, *pdf, params, interop::KERNEL_TEXEL, *device, report);
  for (interop::Light& light : lights) light.variance = 0;
  return {std::move(lights), {}};
}

}  // namespace vsgl
