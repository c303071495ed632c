#include "stages/lights/filtered.h"

#include "math/light_source.h"
#include "pyramid/kernels.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

interop::vec3 to_float(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Vec3 to_double(interop::vec3 v) {
  return {v.x, v.y, v.z};
}

// Makes the texel under the kernel's centre the light's representative. A cluster whose normals cancel takes
// the texel's normal.
void represent(interop::Light& light, const RsmLayer& layer) {
  const interop::Surface& surface = layer.surface[light.texel];
  light.origin = surface.position;
  light.shading_normal = surface.shading_normal;
  light.incident = to_float(direction_to_source(layer.light, to_double(surface.position)));
  light.alpha = surface.alpha;
  light.ndf = surface.ndf;
  if (to_double(light.normal) == Vec3{}) light.normal = surface.normal;
}

}  // namespace

std::vector<interop::Light> sample_lights(const Rsm& rsm, const Pdf& pdf, const LightsParams& params,
                                          std::uint32_t rule, gpu::Device& device, Report& report) {
  KernelParams kernel_params;
  kernel_params.count = static_cast<std::uint32_t>(params.count);
  kernel_params.points = point_set_kind(params.points);
  kernel_params.rule = rule;
  kernel_params.scale = params.kernel_scale;
  kernel_params.seed = params.seed;
  std::vector<DensityPyramid> densities;
  for (const Pdf::Layer& layer : pdf.layers) densities.push_back({pdf.size, layer.pyramid});
  return filter_lights(rsm, draw_kernels(densities, kernel_params, device, report), device, report);
}

std::vector<interop::Light> filter_lights(const Rsm& rsm, std::span<const interop::Kernel> kernels,
                                          gpu::Device& device, Report& report) {
  std::vector<std::span<const interop::Moments>> moments;
  for (const RsmLayer& layer : rsm.layers) moments.emplace_back(layer.pyramid);
  const double deviation = footprint_floor * rsm.scene_radius;
  auto lights = filter_moments(kernels, moments, rsm.size, deviation * deviation, device, report);
  for (interop::Light& light : lights) represent(light, rsm.layers[light.layer]);
  return lights;
}

}  // namespace vsgl
