#include "stages/lights/filtered.h"

#include <algorithm>

#include "math/interop_vec.h"
#include "math/light_source.h"
#include "math/lobe.h"
#include "math/progressive.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

using interop::vec3;

double luminance_of(vec3 c) {
  return luminance(to_double(c));
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

// What is left of a texel's variance where a pass wants a kernel smaller than a texel. Its share of the samples
// is wanted to be T = K g / N, g = radius2_scale(), and a texel's is F = p / M = 1 / (N power_scale): the
// variance is T / F of a texel's, over what that was in the first pass if T was too small already then.
double shrink_below_texel(const interop::Kernel& kernel, const LightsParams& params) {
  if (kernel.level > 0) return 1;
  const double first_share = params.kernel_scale * static_cast<double>(kernel.power_scale);
  return std::min(1.0, radius2_scale(params.pass) * std::max(1.0, first_share));
}

}  // namespace

void represent(interop::Light& light, const RsmLayer& layer) {
  const interop::Surface& surface = layer.surface[light.texel];
  light.origin = surface.position;
  light.shading_normal = surface.shading_normal;
  light.incident = to_float(direction_to_source(layer.light, to_double(surface.position)));
  light.alpha = surface.alpha;
  light.ndf = surface.ndf;
  if (to_double(light.normal) == Vec3{}) light.normal = surface.normal;
}

std::uint32_t share_rule(const LightsParams& params) {
  return params.kernel_solver == "newton" ? interop::KERNEL_NEWTON : interop::KERNEL_BISECTION;
}

KernelParams kernel_params(const LightsParams& params, std::uint32_t rule) {
  KernelParams out;
  out.count = static_cast<std::uint32_t>(params.count);
  out.points = point_set_kind(params.points);
  out.rule = rule;
  out.scale = params.kernel_scale * radius2_scale(params.pass);
  out.seed = pass_seed(params.seed, params.pass);
  return out;
}

std::vector<DensityPyramid> densities_of(const Pdf& pdf) {
  std::vector<DensityPyramid> densities;
  for (const Pdf::Layer& layer : pdf.layers) densities.push_back({pdf.size, layer.pyramid});
  return densities;
}

void conserve_power(const Rsm& rsm, const LightsParams& params, std::vector<interop::Light>& lights,
                    Report& report) {
  const double ratio = power_ratio(rsm, lights);
  report.count("power_ratio_of_paper", ratio);
  if (params.power == "paper" || ratio <= 0) return;
  for (interop::Light& light : lights) {
    light.power_diffuse = scaled(light.power_diffuse, static_cast<float>(1 / ratio));
    light.power_specular = scaled(light.power_specular, static_cast<float>(1 / ratio));
  }
}

std::vector<interop::Light> sample_lights(const Rsm& rsm, const Pdf& pdf, const LightsParams& params,
                                          std::uint32_t rule, gpu::Device& device, Report& report) {
  const auto kernels = draw_kernels(densities_of(pdf), kernel_params(params, rule), device, report);
  auto lights = filter_lights(rsm, kernels, params, device, report);
  for (std::size_t i = 0; i < lights.size() && rule != interop::KERNEL_TEXEL; ++i)
    lights[i].variance *= static_cast<float>(shrink_below_texel(kernels[i], params));
  return lights;
}

std::vector<interop::Light> filter_lights(const Rsm& rsm, std::span<const interop::Kernel> kernels,
                                          const LightsParams& params, gpu::Device& device, Report& report) {
  std::vector<std::span<const interop::Moments>> moments;
  for (const RsmLayer& layer : rsm.layers) moments.emplace_back(layer.pyramid);
  const double deviation = footprint_floor * rsm.scene_radius;
  auto lights = filter_moments(kernels, moments, rsm.size, deviation * deviation, device, report,
                               lobe_filter_kind(params.lobe_filter));
  for (interop::Light& light : lights) represent(light, rsm.layers[light.layer]);
  return lights;
}

}  // namespace vsgl
