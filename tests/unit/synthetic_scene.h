#pragma once

// Scenes built by hand, lights placed by hand, and exact visibility by ray casting.

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "artifact/artifact.h"
#include "scene/scene.h"

namespace vsgl::test {

inline interop::vec3 narrow(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Vec3 widen(interop::vec3 v) {
  return {v.x, v.y, v.z};
}

inline void add_triangle(scene::Scene& scene, Vec3 a, Vec3 b, Vec3 c,
                         std::array<std::array<float, 2>, 3> uv = {}) {
  if (scene.instances.empty()) scene.instances.emplace_back();
  if (scene.materials.empty()) scene.materials.emplace_back();
  auto& instance = scene.instances.front();
  const Vec3 n = normalise(cross(b - a, c - a));
  int i = 0;
  for (const Vec3 p : {a, b, c}) {
    scene::Vertex vertex{};
    const auto position = narrow(p), normal = narrow(n);
    vertex.position = {position.x, position.y, position.z};
    vertex.normal = {normal.x, normal.y, normal.z};
    vertex.uv = uv[i++];
    instance.indices.push_back(static_cast<std::uint32_t>(instance.vertices.size()));
    instance.vertices.push_back(vertex);
  }
}

inline void add_quad(scene::Scene& scene, Vec3 corner, Vec3 u, Vec3 v) {
  add_triangle(scene, corner, corner + u, corner + u + v, {{{0, 0}, {1, 0}, {1, 1}}});
  add_triangle(scene, corner, corner + u + v, corner + v, {{{0, 0}, {1, 1}, {0, 1}}});
}

// The box low..high, seen from inside or outside alike (points are two-sided).
inline void add_box(scene::Scene& scene, Vec3 low, Vec3 high) {
  const Vec3 e = high - low, x{e.x, 0, 0}, y{0, e.y, 0}, z{0, 0, e.z};
  add_quad(scene, low, x, y);
  add_quad(scene, low + z, x, y);
  add_quad(scene, low, x, z);
  add_quad(scene, low + y, x, z);
  add_quad(scene, low, y, z);
  add_quad(scene, low + x, y, z);
}

inline void add_disk(scene::Scene& scene, Vec3 centre, double radius, int segments = 64) {
  const auto rim = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    return centre + radius * Vec3{std::cos(angle), std::sin(angle), 0};
  };
  for (int i = 0; i < segments; ++i) add_triangle(scene, centre, rim(i), rim(i + 1));
}

// By latitude and longitude, inscribed.
inline void add_sphere(scene::Scene& scene, Vec3 centre, double radius, int segments = 48) {
  const auto at = [&](int i, int j) {
    const double theta = std::numbers::pi * i / (segments / 2), phi = 2 * std::numbers::pi * j / segments;
    return centre +
           radius * Vec3{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
  };
  for (int i = 0; i < segments / 2; ++i)
    for (int j = 0; j < segments; ++j) {
      add_triangle(scene, at(i, j), at(i + 1, j), at(i + 1, j + 1));
      add_triangle(scene, at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
}

// A flat cluster of unit power.
inline interop::Light make_light(Vec3 position, Vec3 normal, double variance = 0) {
  interop::Light light{};
  light.position = light.origin = narrow(position);
  light.normal = light.shading_normal = light.diffuse_axis = light.specular_axis = light.incident =
      narrow(normal);
  light.variance = static_cast<float>(variance);
  light.power_diffuse = {1, 1, 1};
  light.diffuse_sharpness = interop::LAMBDA_DIFFUSE;
  return light;
}

inline Lights make_lights(const scene::Scene& scene, std::vector<interop::Light> lights) {
  Lights out;
  out.method = "test";
  out.anchor = scene.anchor;
  out.scene_radius = scene.radius;
  out.requested = static_cast<int>(lights.size());
  out.lights = std::move(lights);
  return out;
}

inline Vec3 position_of(const scene::Vertex& v) {
  return {v.position[0], v.position[1], v.position[2]};
}

// [Moller and Trumbore 1997] whether the open segment from a to b meets the triangle, 1e-6 of its length left
// out at both ends.
inline bool hits(Vec3 a, Vec3 b, Vec3 p0, Vec3 p1, Vec3 p2) {
  const Vec3 direction = b - a, e1 = p1 - p0, e2 = p2 - p0, p = cross(direction, e2);
  const double determinant = dot(e1, p);
  if (determinant == 0) return false;
  const Vec3 s = a - p0, q = cross(s, e1);
  const double u = dot(s, p) / determinant, v = dot(direction, q) / determinant, t = dot(e2, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && t > 1e-6 && t < 1 - 1e-6;
}

inline bool is_visible(const scene::Scene& scene, Vec3 a, Vec3 b) {
  for (const auto& instance : scene.instances)
    for (std::size_t i = 0; i + 2 < instance.indices.size(); i += 3) {
      const auto corner = [&](int k) { return position_of(instance.vertices[instance.indices[i + k]]); };
      if (hits(a, b, corner(0), corner(1), corner(2))) return false;
    }
  return true;
}

// A point on the inside of the box low..high and the wall's normal, from three numbers in [0,1).
struct WallPoint {
  Vec3 position, normal;
};
inline WallPoint wall_point(Vec3 low, Vec3 high, double wall, double s, double t) {
  const int face = static_cast<int>(wall * 6), axis = face / 2;
  std::array<double, 3> place{}, normal{};
  const auto a = to_array(low), b = to_array(high);
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  place[axis] = face % 2 ? b[axis] : a[axis];
  place[first] = a[first] + s * (b[first] - a[first]);
  place[second] = a[second] + t * (b[second] - a[second]);
  normal[axis] = face % 2 ? -1 : 1;
  return {to_vec3(place), to_vec3(normal)};
}

}  // namespace vsgl::test
