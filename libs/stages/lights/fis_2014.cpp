#include "stages/lights/filtered.h"
#include "stages/lights/methods.h"

namespace vsgl {

// [Tokuyoshi 2014, section 3.2; Tokuyoshi 2016, Eqs. (1), (4)] kernel and power from the density at the
// kernel's centre. The older method, for comparison: its lights' powers do not add up to the RSM's.
LightSet generate_fis_2014(const Rsm& rsm, const Pdf* pdf, const LightsParams& params, gpu::Device* device,
                           Report& report) {
  return {sample_lights(rsm, *pdf, params, interop::KERNEL_DENSITY, *device, report), {}};
}

}  // namespace vsgl
