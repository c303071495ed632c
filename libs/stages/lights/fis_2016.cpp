#include "math/vec.h"
#include "stages/lights/filtered.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

using interop::vec3;

double luminance_of(vec3 c) {
  return luminance({c.x, c.y, c.z});
}
vec3 scaled(vec3 c, float s) {
  return {c.x * s, c.y * s, c.z * s};
}

// Luminance of all lights' power over that of all texels.
double power_ratio(const Rsm& rsm, const std::vector<interop::Light>& lights) {
  double emitted = 0, reflected = 0;
  for (const interop::Light& light : lights)
    emitted += luminance_of(light.power_diffuse) + luminance_of(light.power_specular);
  for (const RsmLayer& layer : rsm.layers)
    reflected += static_cast<double>(layer.surface.size()) * static_cast<double>(layer.pyramid.back().weight);
  return reflected > 0 ? emitted / reflected : 1;
}

}  // namespace

// [Tokuyoshi 2016, Eqs. (3), (5)] kernel and power from the density's integral over the kernel.
// Deviation: all powers are scaled by one factor, so that they add up to the RSM's. Eq. (5) alone loses some
// per cent where power over density changes within kernels, since the wide kernels on the side of low density
// reach across.
LightSet generate_fis_2016(const Rsm& rsm, const Pdf* pdf, const LightsParams& params, gpu::Device* device,
                           Report& report) {
  const std::uint32_t rule =
      params.kernel_solver == "newton" ? interop::KERNEL_NEWTON : interop::KERNEL_BISECTION;
  auto lights = sample_lights(rsm, *pdf, params, rule, *device, report);
  const double ratio = power_ratio(rsm, lights);
  report.count("power_ratio_of_paper", ratio);
  if (params.power == "paper" || ratio <= 0) return {std::move(lights), {}};
  for (interop::Light& light : lights) {
    light.power_diffuse = scaled(light.power_diffuse, static_cast<float>(1 / ratio));
    light.power_specular = scaled(light.power_specular, static_cast<float>(1 / ratio));
  }
  return {std::move(lights), {}};
}

}  // namespace vsgl
