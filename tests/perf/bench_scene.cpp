#include "bench_scene.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace vsgl::bench {
namespace {

interop::vec3 to_float(Vec3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

// Where the ray from the origin leaves the box [-1, 1]^3, and the inward normal there.
void leave_box(Vec3 direction, Vec3& position, Vec3& normal) {
  const Vec3 a{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
  const double reach = std::max({a.x, a.y, a.z});
  position = direction / reach;
  normal = a.x == reach ? Vec3{-std::copysign(1.0, direction.x), 0, 0}
           : a.y == reach ? Vec3{0, -std::copysign(1.0, direction.y), 0}
                          : Vec3{0, 0, -std::copysign(1.0, direction.z)};
}

}  // namespace

GBuffer make_gbuffer(const SceneOptions& options) {
  GBuffer out;
  out.width = options.width;
  out.height = options.height;
  out.scene_radius = std::sqrt(3.0);
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      Vec3 position, normal;
      leave_box(Vec3{(x + 0.5) / options.width * 2 - 1, 1 - (y + 0.5) / options.height * 2, -0.7}, position, normal);
      interop::Surface s;
      s.position = to_float(position);
      s.normal = s.shading_normal = to_float(normal);
      s.id = 0;
      s.diffuse = {0.6f, 0.5f, 0.4f};
      s.depth = static_cast<float>(length(position));
      s.ndf = options.receiver_ndf;
      s.alpha = options.receiver_ndf == interop::NDF_NONE ? 1.0f : options.alpha;
      if (options.receiver_ndf != interop::NDF_NONE) s.specular = {0.3f, 0.3f, 0.4f};
      out.pixels.push_back(s);
    }
  return out;
}

Lights make_lights(const SceneOptions& options) {
  Lights out;
  out.method = "fis-2016";
  out.scene_radius = std::sqrt(3.0);
  out.requested = options.lights;
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int i = 0; i < options.lights; ++i) {
    Vec3 position, normal;
    leave_box(Vec3{uniform() * 2 - 1, uniform() * 2 - 1, uniform() * 2 - 1}, position, normal);
    const Vec3 incident = normalise(normal + Vec3{uniform() - 0.5, uniform() - 0.5, uniform() - 0.5});
    interop::Light light;
    light.position = light.origin = to_float(position);
    light.variance = static_cast<float>(std::pow(10.0, -4 + 2 * uniform()));
    light.power_diffuse = {0.2f, 0.1f, 0.1f};
    light.diffuse_axis = light.normal = light.shading_normal = to_float(normal);
    light.diffuse_sharpness = interop::LAMBDA_DIFFUSE;
    light.incident = to_float(incident);
    light.specular_axis = to_float(2 * dot(incident, normal) * normal - incident);
    light.ndf = options.emission_ndf;
    light.alpha = options.alpha;
    if (options.emission_ndf != interop::NDF_NONE) {
      light.power_specular = {0.1f, 0.1f, 0.1f};
      light.specular_sharpness = static_cast<float>(10 + 90 * uniform());
    }
    out.lights.push_back(light);
  }
  return out;
}

}  // namespace vsgl::bench
