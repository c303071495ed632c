#pragma once

// Scenes and visible points built by hand for the tests of the reference.

#include <vector>

#include "artifact/artifact.h"
#include "interop/model.h"
#include "math/interop_vec.h"
#include "scene/scene.h"

namespace vsgl::test {

inline scene::Material matte(Vec3 reflectance) {
  scene::Material m;
  m.base_color = reflectance;
  m.specular = {};
  return m;
}

inline scene::Material glossy(Vec3 diffuse, Vec3 specular, double alpha,
                              std::uint32_t ndf = interop::NDF_GGX) {
  scene::Material m;
  m.base_color = diffuse;
  m.specular = specular;
  m.alpha = alpha;
  m.ndf = ndf;
  return m;
}

inline std::array<float, 3> to_floats(Vec3 v) {
  const interop::vec3 f = to_float(v);
  return {f.x, f.y, f.z};
}

// The parallelogram of corner, corner + u, corner + u + v, corner + v as an instance of its own; texture
// coordinates 0..1 along u and v. `bend` is added to its normals of shading.
inline void add_parallelogram(scene::Scene& scene, Vec3 corner, Vec3 u, Vec3 v,
                              const scene::Material& material, Vec3 bend = {}) {
  scene::Instance instance;
  instance.material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(material);
  const Vec3 n = normalise(normalise(cross(u, v)) + bend);
  for (const auto& [a, b] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
    instance.vertices.push_back({to_floats(corner + a * u + b * v),
                                 to_floats(n),
                                 {},
                                 {static_cast<float>(a), static_cast<float>(b)}});
  instance.indices = {0, 1, 2, 0, 2, 3};
  scene.instances.push_back(std::move(instance));
}

inline LightSource point_light(Vec3 position, Vec3 intensity) {
  LightSource light;
  light.type = LightType::point;
  light.position = position;
  light.intensity = intensity;
  return light;
}

inline LightSource sun(Vec3 direction, Vec3 irradiance) {
  LightSource light;
  light.type = LightType::directional;
  light.forward = normalise(direction);
  light.intensity = irradiance;
  return light;
}

inline LightSource spot_light(Vec3 position, Vec3 target, double cos_inner, double cos_outer,
                              Vec3 intensity) {
  LightSource light;
  light.type = LightType::spot;
  light.position = position;
  light.forward = normalise(target - position);
  light.cos_inner = cos_inner;
  light.cos_outer = cos_outer;
  light.intensity = intensity;
  return light;
}

// A visible point with a material of the scene, which has no textures.
inline interop::Surface visible_point(Vec3 position, Vec3 normal, const scene::Material& material,
                                      Vec3 bend = {}) {
  interop::Surface s{};
  s.position = to_float(position);
  s.normal = to_float(normal);
  s.shading_normal = to_float(normalise(normal + bend));
  s.diffuse = to_float((1 - material.metallic) * material.base_color);
  const Vec3 specular = (1 - material.metallic) * material.specular + material.metallic * material.base_color;
  s.specular = to_float(specular);
  s.ndf = luminance(specular) > 0 ? material.ndf : interop::NDF_NONE;
  s.alpha = s.ndf == interop::NDF_NONE ? 1 : static_cast<float>(material.alpha);
  return s;
}

// A row of visible points that are far enough from each other for the reference to find the light of each
// apart.
constexpr int kSpacing = 8;
inline GBuffer row_of(const scene::Scene& scene, Vec3 camera, const std::vector<interop::Surface>& points) {
  GBuffer out;
  out.width = kSpacing * static_cast<int>(points.size());
  out.height = 1;
  out.anchor = scene.anchor;
  out.camera = camera;
  out.scene_radius = scene.radius;
  interop::Surface nothing{};
  nothing.alpha = 1;
  nothing.id = interop::NO_INSTANCE;
  out.pixels.assign(kSpacing * points.size(), nothing);
  for (std::size_t i = 0; i < points.size(); ++i) out.pixels[kSpacing * i] = points[i];
  return out;
}

}  // namespace vsgl::test
