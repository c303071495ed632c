#include "stages/lights/filtered.h"
#include "stages/lights/methods.h"

namespace vsgl {

// [Tokuyoshi 2016, Eqs. (3), (5)] kernel and power from the density's integral over the kernel.
std::vector<interop::Light> generate_fis_2016(const Rsm& rsm, const Pdf& pdf, const LightsParams& params,
                                              gpu::Device& device, Report& report) {
  const std::uint32_t rule =
      params.kernel_solver == "newton" ? interop::KERNEL_NEWTON : interop::KERNEL_BISECTION;
  return sample_lights(rsm, pdf, params, rule, device, report);
}

}  // namespace vsgl
