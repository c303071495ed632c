#pragma once

// Interleaved sampling: in each square of 4x4 pixels every pixel sums another sixteenth of the lights, and
// takes the other fifteen from its neighbours.

#include <vector>

#include "stages/shading/device_pass.h"

namespace vsgl {

// Sums of each pixel of the G-buffer. Pixels with a specular lobe of alpha below 0.25 sum all lights, and so
// do pixels for those subsets that no similar neighbour has.
std::vector<interop::ShadingSums> run_interleaved(const GBuffer& gbuffer,
                                                  const std::vector<ReceiverList>& receivers,
                                                  const std::vector<LightList>& lights, DevicePass& pass,
                                                  Report& report);

}  // namespace vsgl
