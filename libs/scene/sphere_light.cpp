#include "scene/sphere_light.h"

#include "base/strict_json.h"

namespace vsgl::scene {
namespace {

constexpr double kMinRadius = 1e-6, kMaxRadius = 1e6;  // m
constexpr double kMaxRadiance = 1e30;

Vec3 vector_of(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

SphereLight read_sphere_light(const JsonValue& object, std::size_t index) {
  SphereLight light;
  const auto name = object.find("name");
  light.name = name ? name->string() : "sphere" + std::to_string(index);
  light.position = vector_of(object.at("position").numbers<3>());
  light.radius = object.at("radius_m").number(kMinRadius, kMaxRadius);
  const JsonValue radiance = object.at("radiance_w_m2_sr");
  if (radiance.raw().is_array())
    light.radiance = vector_of(radiance.numbers<3>(0, kMaxRadiance));
  else
    light.radiance = Vec3{1, 1, 1} * radiance.number(0, kMaxRadiance);
  object.finish();
  return light;
}

}  // namespace

std::vector<SphereLight> read_sphere_lights(const JsonValue& root) {
  std::vector<SphereLight> out;
  if (const auto lights = root.find("sphere_lights"))
    for (const JsonValue& light : lights->array()) out.push_back(read_sphere_light(light, out.size()));
  return out;
}

}  // namespace vsgl::scene
