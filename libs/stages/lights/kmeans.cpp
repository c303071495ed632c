#include "kmeans/kmeans.h"

#include <cmath>

#include "math/lobe.h"
#include "stages/lights/filtered.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

// Root mean square distance of the texels' power from their centres, in units of `space`.
double rms_distance(const Rsm& rsm, double cost) {
  double power = 0;
  for (const RsmLayer& layer : rsm.layers)
    power += static_cast<double>(layer.surface.size()) * static_cast<double>(layer.pyramid.back().weight);
  return std::sqrt(cost / power);
}

LightSet generate(const Rsm& rsm, const Pdf& pdf, std::uint32_t space, const LightsParams& params,
                  gpu::Device& device, Report& report) {
  std::vector<std::span<const interop::Moments>> layers;
  for (const RsmLayer& layer : rsm.layers) layers.emplace_back(layer.pyramid);
  const auto centres = choose_centres(densities_of(pdf), layers, space,
                                      kernel_params(params, interop::KERNEL_TEXEL), device, report);
  if (centres.empty()) return {};
  const double deviation = footprint_floor * rsm.scene_radius;
  Clusters clusters = cluster_texels(layers, rsm.size, centres,
                                     {.space = space,
                                      .iterations = params.kmeans_iterations,
                                      .normal_weight = params.kmeans_normal_weight,
                                      .scene_radius = rsm.scene_radius,
                                      .variance_floor = deviation * deviation,
                                      .lobe_filter = lobe_filter_kind(params.lobe_filter)},
                                     device, report);
  report.count("kmeans_iterations", clusters.iterations);
  report.count("kmeans_rms_distance", rms_distance(rsm, clusters.cost));
  for (interop::Light& light : clusters.lights)
    if (has_power(light)) represent(light, rsm.layers[light.layer]);
  return {std::move(clusters.lights), {}};
}

}  // namespace

// [Tokuyoshi 2016, appendix D] every texel goes to the nearest of the sampled texels, in the RSM's plane.
LightSet generate_kmeans_2d(const Rsm& rsm, const Pdf* pdf, const LightsParams& params, gpu::Device* device,
                            Report& report) {
  return generate(rsm, *pdf, interop::KMEANS_2D, params, *device, report);
}

// The same in the scene.
LightSet generate_kmeans_3d(const Rsm& rsm, const Pdf* pdf, const LightsParams& params, gpu::Device* device,
                            Report& report) {
  return generate(rsm, *pdf, interop::KMEANS_3D, params, *device, report);
}

}  // namespace vsgl
