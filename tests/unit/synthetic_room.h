#pragma once

// A room with a sphere, seen by closed-form ray casting: RSMs and G-buffers for tests of the stages,
// independent of the rasteriser.

#include <algorithm>
#include <cmath>
#include <vector>

#include "artifact/artifact.h"
#include "math/lobe.h"
#include "math/microfacet.h"
#include "math/moments.h"
#include "math/sampling.h"

namespace vsgl::test {

inline interop::vec3 to_float(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Vec3 to_double(interop::vec3 v) {
  return {v.x, v.y, v.z};
}

struct Hit {
  double distance = 1e30;
  Vec3 normal, albedo, specular;
};

// The box [-2,2] x [0,3] x [-2,2] seen from inside: red and green side walls, chequered floor.
inline void hit_walls(Vec3 o, Vec3 d, Hit& hit) {
  const double origin[3] = {o.x, o.y, o.z}, direction[3] = {d.x, d.y, d.z};
  const double low[3] = {-2, 0, -2}, high[3] = {2, 3, 2};
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    const bool up = direction[axis] > 0;
    const double t = ((up ? high : low)[axis] - origin[axis]) / direction[axis];
    if (t >= hit.distance) continue;
    hit.distance = t;
    const double n = up ? -1 : 1;
    hit.normal = {axis == 0 ? n : 0, axis == 1 ? n : 0, axis == 2 ? n : 0};
    hit.albedo = axis == 0 ? (up ? Vec3{0.1, 0.7, 0.1} : Vec3{0.7, 0.1, 0.1}) : Vec3{0.7, 0.7, 0.7};
    const Vec3 y = o + d * t;
    const bool dark = axis == 1 && !up && (std::lround(std::floor(4 * y.x) + std::floor(4 * y.z)) & 1);
    if (dark) hit.albedo = {0.05, 0.05, 0.05};
    hit.specular = axis == 1 && !up ? Vec3{0.3, 0.3, 0.2} : Vec3{};
  }
}

inline void hit_sphere(Vec3 o, Vec3 d, Vec3 centre, double radius, Hit& hit) {
  const Vec3 c = o - centre;
  const double b = dot(c, d), discriminant = b * b - dot(c, c) + radius * radius;
  if (discriminant <= 0) return;
  const double t = -b - std::sqrt(discriminant);
  if (t <= 0 || t >= hit.distance) return;
  hit = {t, normalise(o + d * t - centre), {0.2, 0.3, 0.8}, {0.4, 0.4, 0.4}};
}

// Unit `direction`.
inline interop::Surface see(Vec3 origin, Vec3 direction, bool with_specular) {
  Hit hit;
  hit_walls(origin, direction, hit);
  hit_sphere(origin, direction, {0.5, 0.5, -0.3}, 0.5, hit);
  interop::Surface s{};
  s.position = to_float(origin + direction * hit.distance);
  s.normal = s.shading_normal = to_float(hit.normal);
  s.diffuse = to_float(hit.albedo);
  s.depth = static_cast<float>(hit.distance);
  s.alpha = 1;
  if (with_specular && hit.specular.x > 0) {
    s.specular = to_float(hit.specular);
    s.alpha = 0.2f;
    s.ndf = interop::NDF_GGX;
  }
  return s;
}

inline interop::Surface nothing() {
  interop::Surface s{};
  s.alpha = 1;
  s.id = interop::NO_INSTANCE;
  return s;
}

inline DoubleMoments reflect(const interop::Surface& s, Vec3 flux, Vec3 incident, double spread) {
  DoubleMoments m;
  m.flux = flux;
  m.power_diffuse = flux * to_double(s.diffuse);
  m.power_specular = flux * to_double(s.specular);
  m.weight = luminance(m.power_diffuse + m.power_specular);
  m.position = to_double(s.position);
  m.spread = spread;
  const LobeMoments diffuse = lobe_encode(to_double(s.normal), interop::LAMBDA_DIFFUSE);
  m.diffuse_mean = diffuse.mean;
  m.diffuse_deficit = diffuse.deficit;
  m.normal_mean = to_double(s.normal);
  if (s.ndf == interop::NDF_NONE) return m;
  const SgLobe lobe = specular_lobe(s.ndf, s.alpha, to_double(s.shading_normal), incident);
  const LobeMoments specular = lobe_encode(lobe.axis, lobe.sharpness);
  m.specular_mean = specular.mean;
  m.specular_deficit = specular.deficit;
  return m;
}

inline interop::Moments to_float(const DoubleMoments& m) {
  interop::Moments out{};
  out.flux = to_float(m.flux);
  out.power_diffuse = to_float(m.power_diffuse);
  out.power_specular = to_float(m.power_specular);
  out.weight = static_cast<float>(m.weight);
  out.position = to_float(m.position);
  out.spread = static_cast<float>(m.spread);
  out.diffuse_mean = to_float(m.diffuse_mean);
  out.diffuse_deficit = static_cast<float>(m.diffuse_deficit);
  out.specular_mean = to_float(m.specular_mean);
  out.specular_deficit = static_cast<float>(m.specular_deficit);
  out.normal_mean = to_float(m.normal_mean);
  out.normal_deficit = static_cast<float>(m.normal_deficit);
  return out;
}

// All levels of level 0's moments, rounded to float at the end.
inline std::vector<interop::Moments> moment_pyramid(std::vector<DoubleMoments> level, int size) {
  const std::vector<double> shares(4, 0.25);
  std::vector<interop::Moments> pyramid;
  for (int side = size;; side /= 2) {
    for (const DoubleMoments& m : level) pyramid.push_back(to_float(m));
    if (side == 1) return pyramid;
    std::vector<DoubleMoments> coarser;
    for (int j = 0; j < side; j += 2)
      for (int i = 0; i < side; i += 2) {
        const auto at = [&](int x, int y) { return level[static_cast<std::size_t>(y * side + x)]; };
        const std::vector<DoubleMoments> taps = {at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)};
        coarser.push_back(merge_moments(taps, shares));
      }
    level = std::move(coarser);
  }
}

// Ray through a texel's centre of a width x height view with square tangents `extent`.
inline Vec3 view_ray(const LightSource& view, int i, int j, int width, int height) {
  const double x = view.extent_x * (2 * (i + 0.5) / width - 1),
               y = view.extent_y * (1 - 2 * (j + 0.5) / height);
  return normalise(view.forward + view.right * x + view.up * y);
}

inline RsmLayer room_layer(const LightSource& light, int size, bool with_specular) {
  RsmLayer layer;
  layer.name = light.name;
  layer.light = light;
  std::vector<DoubleMoments> level0;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const Vec3 ray = view_ray(light, i, j, size, size);
      const double cosine = dot(ray, light.forward);
      layer.surface.push_back(see(light.position, ray, with_specular));
      const interop::Surface& s = layer.surface.back();
      const double texel = 2 * light.extent_x / size, solid_angle = texel * texel * cosine * cosine * cosine;
      const double width = texel * static_cast<double>(s.depth);  // of the texel on the surface, roughly
      level0.push_back(reflect(s, light.intensity * solid_angle, -ray, width * width / 6));
    }
  layer.pyramid = moment_pyramid(std::move(level0), size);
  return layer;
}

// One layer per light, `lights` = 1 or 2.
inline Rsm room_rsm(int size, int lights = 1, bool with_specular = true) {
  LightSource lamp;
  lamp.name = "lamp";
  lamp.position = {-0.6, 2.6, 0.4};
  lamp.forward = {0, -1, 0};
  lamp.right = {1, 0, 0};
  lamp.up = {0, 0, -1};
  lamp.intensity = {10, 9, 7};
  LightSource wall = lamp;
  wall.name = "wall";
  wall.position = {1.2, 1.5, 1.2};
  wall.forward = {0, 0, -1};
  wall.up = {0, 1, 0};
  wall.extent_x = wall.extent_y = 0.5;
  wall.intensity = {1, 2, 30};
  Rsm rsm;
  rsm.size = rsm.width = rsm.height = size;
  rsm.scene_radius = 3.2;
  rsm.layers.push_back(room_layer(lamp, size, with_specular));
  if (lights > 1) rsm.layers.push_back(room_layer(wall, size, with_specular));
  return rsm;
}

inline GBuffer room_gbuffer(int width, int height, bool with_specular = true) {
  LightSource camera;
  camera.position = {0, 1.5, 1.9};
  camera.forward = {0, 0, -1};
  camera.extent_x = 1;
  camera.extent_y = static_cast<double>(height) / width;
  GBuffer gbuffer;
  gbuffer.width = width;
  gbuffer.height = height;
  gbuffer.camera = camera.position;
  gbuffer.scene_radius = 3.2;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      gbuffer.pixels.push_back(see(camera.position, view_ray(camera, i, j, width, height), with_specular));
  return gbuffer;
}

// Luminance of a layer's, or all layers', reflected power, W.
inline double reflected_power(const Rsm& rsm) {
  double sum = 0;
  for (const RsmLayer& layer : rsm.layers)
    sum += static_cast<double>(layer.pyramid.back().weight) * rsm.size * rsm.size;
  return sum;
}

// A density from level-0 values of every layer, scaled to mean 1.
inline Pdf make_pdf(const Rsm& rsm, const std::vector<std::vector<double>>& values) {
  double sum = 0;
  for (const auto& layer : values)
    for (double v : layer) sum += v;
  Pdf pdf;
  pdf.size = rsm.size;
  pdf.method = "test";
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::vector<float> level0;
    for (double v : values[k])
      level0.push_back(static_cast<float>(sum > 0 ? v * static_cast<double>(rsm.texel_count()) / sum : 0));
    pdf.layers.push_back({rsm.layers[k].name, mean_pyramid(level0, rsm.size)});
  }
  return pdf;
}
// Proportional to the reflected power.
inline Pdf flux_pdf(const Rsm& rsm) {
  std::vector<std::vector<double>> values;
  for (const RsmLayer& layer : rsm.layers) {
    values.emplace_back();
    for (int k = 0; k < rsm.size * rsm.size; ++k)
      values.back().push_back(static_cast<double>(layer.pyramid[static_cast<std::size_t>(k)].weight));
  }
  return make_pdf(rsm, values);
}

}  // namespace vsgl::test
