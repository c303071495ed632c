#pragma once

// The inside of the box [-1, 1]^3, seen from its centre and lit by virtual lights on its walls: input of the
// shading tests and of the benchmark.

#include <algorithm>
#include <cmath>
#include <random>

#include "artifact/artifact.h"

namespace vsgl::test {

struct BoxOptions {
  int width = 16, height = 9, lights = 12;
  std::uint32_t receiver_ndf = interop::NDF_NONE;  // of every pixel
  std::uint32_t emission_ndf = interop::NDF_NONE;  // of every light
  float alpha = 0.2f;
  double sigma = 0.05;  // m, of the lights' footprints, varied by a factor of 3 either way
  double tilt = 0;      // how far shading normals lean, of pixels and lights
};

inline interop::vec3 to_float(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Vec3 to_double(interop::vec3 v) {
  return {v.x, v.y, v.z};
}

// Where the ray from the centre leaves the box, and the inward normal there.
inline void leave_box(Vec3 direction, Vec3& position, Vec3& normal) {
  const Vec3 a{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
  const double reach = std::max({a.x, a.y, a.z});
  position = direction / reach;
  normal = a.x == reach   ? Vec3{-position.x, 0, 0}
           : a.y == reach ? Vec3{0, -position.y, 0}
                          : Vec3{0, 0, -position.z};
}

// Random numbers in 0..1, the same in every run.
class Uniform {
 public:
  double operator()() { return static_cast<double>(random_()) / 4294967296.0; }
  Vec3 vector() { return {2 * (*this)() - 1, 2 * (*this)() - 1, 2 * (*this)() - 1}; }

 private:
  std::mt19937 random_{7};
};

inline interop::Surface background() {
  interop::Surface s;
  s.alpha = 1;
  s.id = interop::NO_INSTANCE;
  return s;
}

inline GBuffer box_gbuffer(const BoxOptions& options) {
  GBuffer out;
  out.width = options.width;
  out.height = options.height;
  out.scene_radius = std::sqrt(3.0);
  Uniform uniform;
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      Vec3 position, normal;
      leave_box({(x + 0.5) / options.width * 2 - 1, 1 - (y + 0.5) / options.height * 2, -0.7}, position,
                normal);
      interop::Surface s;
      s.position = to_float(position);
      s.normal = to_float(normal);
      s.shading_normal = to_float(normalise(normal + options.tilt * uniform.vector()));
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

inline interop::Light box_light(const BoxOptions& options, Uniform& uniform) {
  Vec3 position, normal;
  leave_box(uniform.vector(), position, normal);
  const Vec3 incident = normalise(normal + 0.5 * uniform.vector());
  const Vec3 shading_normal = normalise(normal + options.tilt * uniform.vector());
  const double sigma = options.sigma * std::pow(3.0, 2 * uniform() - 1);
  interop::Light light{};
  light.position = light.origin = to_float(position);
  light.variance = static_cast<float>(sigma * sigma);
  light.power_diffuse = {0.2f, 0.1f, 0.1f};
  light.diffuse_axis = light.normal = to_float(normal);
  light.diffuse_sharpness = interop::LAMBDA_DIFFUSE;
  light.shading_normal = to_float(shading_normal);
  light.incident = to_float(incident);
  light.specular_axis = to_float(2 * dot(incident, shading_normal) * shading_normal - incident);
  light.specular_sharpness = static_cast<float>(std::pow(10.0, 1 + uniform()));
  light.ndf = options.emission_ndf;
  light.alpha = options.emission_ndf == interop::NDF_NONE ? 1.0f : options.alpha;
  if (options.emission_ndf != interop::NDF_NONE) light.power_specular = {0.1f, 0.1f, 0.15f};
  return light;
}

inline Lights box_lights(const BoxOptions& options) {
  Lights out;
  out.method = "fis-2016";
  out.scene_radius = std::sqrt(3.0);
  out.requested = options.lights;
  Uniform uniform;
  for (int i = 0; i < options.lights; ++i) out.lights.push_back(box_light(options, uniform));
  return out;
}

}  // namespace vsgl::test
