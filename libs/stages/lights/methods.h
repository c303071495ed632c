#pragma once

// One function per method; see lights_methods().

#include "stages/lights/lights.h"

namespace vsgl {

std::vector<interop::Light> generate_vpl(const Rsm&, const Pdf*, const LightsParams&, gpu::Device&, Report&);
std::vector<interop::Light> generate_fis_2014(const Rsm&, const Pdf*, const LightsParams&, gpu::Device&,
                                              Report&);
std::vector<interop::Light> generate_fis_2016(const Rsm&, const Pdf*, const LightsParams&, gpu::Device&,
                                              Report&);
std::vector<interop::Light> generate_texels(const Rsm&, const Pdf*, const LightsParams&, gpu::Device&,
                                            Report&);

}  // namespace vsgl
