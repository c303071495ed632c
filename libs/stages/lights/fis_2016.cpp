#include "stages/lights/filtered.h"
#include "stages/lights/methods.h"

namespace vsgl {

// [Tokuyoshi 2016, Eqs. (3), (5)] kernel and power from the density's integral over the kernel.
// Deviation: all powers are scaled by one factor, so that they add up to the RSM's. Eq. (5) alone loses some
// per cent where power over density changes within kernels, since the wide kernels on the side of low density
// reach across.
LightSet generate_fis_2016(const Rsm& rsm, const Pdf* pdf, const LightsParams& params, gpu::Device* device,
                           Report& report) {
  LightSet set;
  set.lights = sample_lights(rsm, *pdf, params, share_rule(params), *device, report);
  conserve_power(rsm, params, set.lights, report);
  return set;
}

}  // namespace vsgl
