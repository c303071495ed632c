#pragma once

// Interleaved sampling: in each square of n x n pixels every pixel sums another of n^2 subsets of the lights,
// and takes the others from its neighbours.

#include <vector>

#include "stages/shading/device_pass.h"

namespace vsgl {

// Sums of each pixel of the G-buffer; `side` is n, a power of two up to 8. Pixels with a specular lobe of
// alpha below 0.25 sum all lights, and so do pixels for those subsets that no similar neighbour has.
std::vector<interop::ShadingSums> run_interleaved(const GBuffer& gbuffer,
                                                  const std::vector<ReceiverList>& receivers,
                                                  const std::vector<LightList>& lights, int side,
                                                  DevicePass& pass, Report& report);

}  // namespace vsgl
