#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "interop/model.h"
#include "math/interop_vec.h"
#include "scene/scene.h"
#include "stages/rsm/rsm.h"

// Scenes built by hand for the tests of the RSM stage.

namespace vsgl::test {

inline gpu::Device& device() {
  static gpu::Device shared({});
  return shared;
}

inline scene::Material diffuse(double reflectance) {
  scene::Material material;
  material.base_color = {reflectance, reflectance, reflectance};
  material.specular = {};
  return material;
}

inline std::array<float, 3> to_array3(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// The parallelogram of corner, corner + u, corner + u + v, corner + v; its front is where u x v points; uv
// 0..1 along u and v.
inline scene::Instance quad(Vec3 corner, Vec3 u, Vec3 v, int material = 0) {
  scene::Instance instance;
  instance.material = material;
  const Vec3 n = normalise(cross(u, v)), t = normalise(u);
  for (const auto& [a, b] : std::vector<std::pair<double, double>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    instance.vertices.push_back(
        {to_array3(corner + a * u + b * v),
         to_array3(n),
         {static_cast<float>(t.x), static_cast<float>(t.y), static_cast<float>(t.z), 1},
         {static_cast<float>(a), static_cast<float>(b)}});
  }
  instance.indices = {0, 1, 2, 0, 2, 3};
  return instance;
}

// A room of half size `half` about the origin, seen from inside.
inline std::vector<scene::Instance> room(double half) {
  const double s = 2 * half;
  return {
      quad({-half, -half, -half}, {s, 0, 0}, {0, s, 0}), quad({-half, -half, half}, {s, 0, 0}, {0, s, 0}),
      quad({-half, -half, -half}, {s, 0, 0}, {0, 0, s}), quad({-half, half, -half}, {s, 0, 0}, {0, 0, s}),
      quad({-half, -half, -half}, {0, s, 0}, {0, 0, s}), quad({half, -half, -half}, {0, s, 0}, {0, 0, s})};
}

// A spot at the origin that shines down -z with intensity (1, 2, 3) W/sr.
inline LightSource spot(double inner_deg, double outer_deg) {
  constexpr double kDegree = std::numbers::pi / 180;
  LightSource light;
  light.name = "key";
  light.type = LightType::spot;
  light.extent_x = light.extent_y = std::tan(outer_deg * kDegree);
  light.intensity = {1, 2, 3};
  light.cos_inner = std::cos(inner_deg * kDegree);
  light.cos_outer = std::cos(outer_deg * kDegree);
  return light;
}

// A plane through (0, 0, -2) whose normal is tilted by `tilt_deg` from +z towards +x; large enough for any
// spot here.
inline scene::Instance tilted_plane(double tilt_deg, int material = 0) {
  const double a = tilt_deg * std::numbers::pi / 180;
  const Vec3 u{std::cos(a), 0, -std::sin(a)}, v{0, 1, 0};
  return quad(Vec3{0, 0, -2} - 50 * u - 50 * v, 100 * u, 100 * v, material);
}

inline scene::Scene scene_of(std::vector<scene::Instance> instances, std::vector<LightSource> lights) {
  scene::Scene scene;
  scene.radius = 10;
  scene.instances = std::move(instances);
  scene.materials = {diffuse(0.5)};
  scene.lights = std::move(lights);
  scene.camera.width = 64;
  scene.camera.height = 48;
  return scene;
}

// Half width, top left texel first: columns of the given colours.
inline scene::Texture stripes(int width, int height, std::vector<std::array<std::uint8_t, 4>> colours,
                              bool srgb = false) {
  scene::Texture texture{"stripes", width, height, srgb, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto& colour =
          colours[static_cast<std::size_t>(x) * colours.size() / static_cast<std::size_t>(width)];
      texture.rgba.insert(texture.rgba.end(), colour.begin(), colour.end());
    }
  }
  return texture;
}

inline Rsm bake(const scene::Scene& scene, int width, int height,
                NormalConvention normals = NormalConvention::consistent) {
  Report report;
  return bake_rsm(scene, {width, height, normals}, device(), report);
}
inline Rsm bake(const scene::Scene& scene, int size) {
  return bake(scene, size, size);
}

inline GBuffer see(const scene::Scene& scene) {
  Report report;
  return bake_gbuffer(scene, device(), report);
}

// Flux of all layers, W.
inline Vec3 total_flux(const Rsm& rsm) {
  Vec3 sum;
  for (const RsmLayer& layer : rsm.layers) {
    for (std::size_t i = 0; i < layer.surface.size(); ++i) sum += to_double(layer.pyramid[i].flux);
  }
  return sum;
}

}  // namespace vsgl::test
