#include <numbers>

#include "math/interop_vec.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

interop::Light light_of(const scene::SphereLight& sphere) {
  using std::numbers::pi;
  const double radius2 = sphere.radius * sphere.radius;
  interop::Light light{};
  light.position = light.origin = to_float(sphere.position);
  light.variance = static_cast<float>(radius2 / 4);
  light.power_diffuse = to_float(4 * pi * pi * radius2 * sphere.radiance);
  light.diffuse_axis = light.specular_axis = {0, 0, 1};  // of sharpness 0: any will do
  light.normal = light.shading_normal = light.incident = {0, 0, 1};
  light.alpha = 1;
  return light;
}

}  // namespace

std::vector<interop::Light> make_sphere_lights(const std::vector<scene::SphereLight>& spheres) {
  std::vector<interop::Light> lights;
  for (const scene::SphereLight& sphere : spheres) lights.push_back(light_of(sphere));
  return lights;
}

}  // namespace vsgl
