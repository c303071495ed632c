#include <algorithm>
#include <cmath>

#include "math/interop_vec.h"
#include "math/point_tree.h"
#include "math/progressive.h"
#include "stages/lights/filtered.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

constexpr double kLargestRadius = 0.1;  // of the scene's radius

}  // namespace

// [Hasan 2009; Tokuyoshi 2014, Sec. 2] the sampled texel as the centre of a sphere, whose radius is the
// distance to the k-th nearest light: that of photon density estimation.
// Deviation: the radius is at least that of the texel's own footprint and at most a tenth of the scene's.
// Held as the variance of a uniform disk of that radius, r^2 / 4 per axis.
LightSet generate_vsl(const Rsm& rsm, const Pdf* pdf, const LightsParams& params, gpu::Device* device,
                      Report& report) {
  auto lights = sample_lights(rsm, *pdf, params, interop::KERNEL_TEXEL, *device, report);
  std::erase_if(lights, [](const interop::Light& light) { return !has_power(light); });
  std::vector<Vec3> positions;
  for (const interop::Light& light : lights) positions.push_back(to_double(light.origin));
  const PointTree tree(positions);
  const double scale = radius2_scale(params.pass), largest = kLargestRadius * rsm.scene_radius;
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const double radius =
        params.vsl_radius_scale *
        std::sqrt(tree.neighbour_distance2(static_cast<std::uint32_t>(i), params.vsl_neighbours));
    const double footprint = 2 * std::sqrt(static_cast<double>(lights[i].variance));
    const double bounded = std::min(std::max(radius, footprint), largest);
    lights[i].variance = static_cast<float>(scale * bounded * bounded / 4);
  }
  return {std::move(lights), {}};
}

}  // namespace vsgl
