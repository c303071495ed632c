#include "stages/visibility/views.h"

#include <algorithm>
#include <cmath>

#include "math/vec.h"

namespace vsgl::visibility {
namespace {

Vec3 widen(interop::vec3 v) {
  return {v.x, v.y, v.z};
}
interop::vec3 narrow(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

interop::SplatView make_view(const interop::Light& light, double scene_radius, double disk_radius) {
  const double sigma = std::sqrt(static_cast<double>(light.variance));
  const Vec3 axis = normalise(widen(light.normal));
  const Vec3 surface = widen(light.origin);
  interop::SplatView view;
  view.origin = narrow(surface + 1e-4 * scene_radius * axis);
  view.near_distance = static_cast<float>(std::max(0.5 * disk_radius, 0.5 * sigma));
  view.axis = narrow(axis);
  view.own_radius = static_cast<float>(3 * sigma);
  view.surface = light.origin;
  return view;
}

bool is_curved(const interop::Light& light) {
  return 1 - static_cast<double>(light.normal_deficit) < curved_mean_normal * curved_mean_normal;
}

bool is_off_centre(const interop::Light& light) {
  const double sigma = std::sqrt(static_cast<double>(light.variance));
  const double distance = length(widen(light.origin) - widen(light.position));
  return distance > 2 * sigma && light.variance > 0;
}

bool has_power(const interop::Light& light) {
  const auto lit = [](interop::vec3 c) { return c.x > 0 || c.y > 0 || c.z > 0; };
  return lit(light.power_diffuse) || lit(light.power_specular);
}

}  // namespace vsgl::visibility
