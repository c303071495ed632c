#include "cluster/cluster.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/interop_vec.h"
#include "math/lobe.h"
#include "math/microfacet.h"

namespace vsgl {
namespace {

using interop::Cluster;
using interop::Light;

bool has_power(interop::vec3 power) {
  return power.x + power.y + power.z > 0;
}

double normal_sharpness(const Light& light) {
  const double deficit = static_cast<double>(light.normal_deficit);
  return lobe_sharpness(std::sqrt(std::max(1 - deficit, 0.0)), deficit);
}

// Part of the way from the mean normal to the half vector that the normals have turned which reflect there:
// of Gaussian lobes all of the normals' share of the variance; of GGX, whose tails reach far from each
// normal, as much of it as fits clusters of a rough normal map best (docs/mathematics.md).
constexpr double kFacetTurn = 0.6;

// A light may hold specular power although its representative point has no specular lobe: it gets the
// broadest.
void set_specular(Cluster& c, const Light& light) {
  const bool has_lobe = light.ndf != interop::NDF_NONE;
  const std::uint32_t ndf = has_lobe ? light.ndf : interop::NDF_GGX;
  const double alpha = has_lobe ? static_cast<double>(light.alpha) : 1, alpha2 = alpha * alpha;
  const double cosine = std::max(dot(to_double(light.shading_normal), to_double(light.incident)), cos_min);
  const double peak = ndf == interop::NDF_GGX ? std::numbers::inv_pi : 1;
  c.incident_masking = static_cast<float>(1 + smith_lambda(ndf, alpha2, cosine));
  c.shading_normal = light.shading_normal;
  const double deficit = static_cast<double>(light.shading_deficit);
  c.facet_turn = static_cast<float>(kFacetTurn * deficit / (alpha2 + deficit));
  c.incident = light.incident;
  c.alpha2 = static_cast<float>(std::min(alpha2 + static_cast<double>(light.lobe_variance), 1.0));
  c.specular = to_float(peak / (4 * cosine) * to_double(light.power_specular));
  c.masking_alpha2 = static_cast<float>(alpha2);
  c.ndf = ndf;
}

Cluster pack(const Light& light, std::uint32_t index, double variance_floor) {
  Cluster c{};
  c.light = index;
  c.children = light.children;
  if (!has_power(light.power_diffuse) && !has_power(light.power_specular)) return c;
  c.position = light.position;
  c.inverse_variance = static_cast<float>(1 / std::max(static_cast<double>(light.variance), variance_floor));
  c.reach = 2 / std::sqrt(c.inverse_variance);
  c.normal = light.normal;
  c.normal_sharpness = static_cast<float>(normal_sharpness(light));
  c.diffuse = to_float(std::numbers::inv_pi * to_double(light.power_diffuse));
  if (has_power(light.power_specular))
    set_specular(c, light);
  else
    c.incident_masking = c.alpha2 = c.masking_alpha2 = 1;
  return c;
}

double distance(interop::vec3 a, interop::vec3 b) {
  return length(to_double(a) - to_double(b));
}

// Lets nodes with texels further than kOutlier deviations from their mean reach these. Children follow their
// parents.
constexpr float kOutlier = 6;
void reach_outliers(std::vector<Cluster>& clusters) {
  std::vector<double> furthest(clusters.size());
  for (std::size_t i = clusters.size(); i-- > 0;) {
    Cluster& c = clusters[i];
    furthest[i] = static_cast<double>(c.reach);
    if (c.children == 0 || c.inverse_variance <= 0) continue;
    furthest[i] = 0;
    for (std::size_t k = c.children; k < c.children + 4; ++k)
      if (clusters[k].inverse_variance > 0)
        furthest[i] = std::max(furthest[i], distance(clusters[k].position, c.position) + furthest[k]);
    const auto reach = static_cast<float>(furthest[i]);
    if (reach * reach * c.inverse_variance > kOutlier * kOutlier) c.reach = reach;
  }
}

}  // namespace

std::vector<Cluster> pack_clusters(const Lights& lights) {
  const double floor = 1e-6 * lights.scene_radius * 1e-6 * lights.scene_radius;
  std::vector<Cluster> clusters(lights.lights.size());
#pragma omp parallel for
  for (std::size_t i = 0; i < clusters.size(); ++i)
    clusters[i] = pack(lights.lights[i], static_cast<std::uint32_t>(i), floor);
  if (lights.is_tree()) reach_outliers(clusters);
  return clusters;
}

}  // namespace vsgl
