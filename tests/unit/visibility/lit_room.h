#pragma once

// A furnished room, seen by a camera, and a light tree of its lit floor.

#include <algorithm>
#include <span>

#include "cluster/traverse.h"
#include "room.h"
#include "trace/tracer.h"

namespace vsgl::test {

inline interop::Surface pixel_at(Vec3 position, Vec3 normal) {
  interop::Surface s{};
  s.position = narrow(position);
  s.normal = s.shading_normal = narrow(normal);
  s.diffuse = {0.5F, 0.5F, 0.5F};
  s.id = 0;
  s.alpha = 1;
  return s;
}

inline GBuffer gbuffer_of(std::vector<interop::Surface> pixels, int width) {
  GBuffer out;
  out.width = width;
  out.height = static_cast<int>(pixels.size()) / width;
  out.scene_radius = std::sqrt(6.0);
  out.pixels = std::move(pixels);
  return out;
}

// A table, a thin post and a ball.
inline scene::Scene furnished_room() {
  scene::Scene scene = room();
  add_box(scene, {-0.5, -0.1, 0.6}, {0.3, 0.6, 0.65});
  add_box(scene, {0.5, 0.1, 0}, {0.55, 0.15, 1.6});
  add_sphere(scene, {-0.6, 0.5, 1.2}, 0.25);
  return scene;
}

// From near one wall towards the opposite one. A surface that a ray meets from behind faces the camera.
inline GBuffer look_into(const scene::Scene& scene, int width, int height) {
  const trace::Tracer tracer(scene);
  std::vector<interop::Surface> pixels;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const Vec3 ray =
          normalise({2 * (i + 0.5) / width - 1, 1, (1 - 2 * (j + 0.5) / height) * height / width});
      const auto hit = tracer.intersect({0, -0.95, 1}, ray);
      const interop::Surface s = tracer.surface(*hit, -ray);
      pixels.push_back(pixel_at(widen(s.position), widen(s.normal)));
    }
  return gbuffer_of(std::move(pixels), width);
}

// Moments of four nodes.
inline interop::Light merge(std::span<const interop::Light> four) {
  double power = 0, spread = 0;
  Vec3 position, normal;
  for (const auto& light : four) {
    const double p = static_cast<double>(light.power_diffuse.x);
    power += p;
    position += p * widen(light.position);
    normal += p * widen(light.normal);
  }
  position = position / power;
  normal = normal / power;
  for (const auto& light : four) {
    const Vec3 v = widen(light.position) - position;
    spread += static_cast<double>(light.power_diffuse.x) / power *
              (dot(v, v) / 2 + static_cast<double>(light.variance));
  }
  interop::Light out = make_light(position, normalise(normal), spread);
  const auto distance = [&](const interop::Light& l) { return length(widen(l.origin) - position); };
  const auto nearest = std::min_element(
      four.begin(), four.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  out.origin = nearest->origin;
  out.incident = nearest->incident;
  out.normal_deficit = static_cast<float>(std::max(1 - dot(normal, normal), 0.0));
  out.power_diffuse = {static_cast<float>(power), static_cast<float>(power), static_cast<float>(power)};
  return out;
}

// Four consecutive leaves, or nodes, have one parent. 4^k leaves.
inline Lights make_tree(const scene::Scene& scene, std::vector<interop::Light> leaves) {
  std::vector<std::vector<interop::Light>> levels{std::move(leaves)};
  while (levels.back().size() > 1) {
    const auto& below = levels.back();
    std::vector<interop::Light> level;
    for (std::size_t i = 0; i < below.size(); i += 4) level.push_back(merge(std::span(below).subspan(i, 4)));
    levels.push_back(std::move(level));
  }
  Lights out = make_lights(scene, {});
  out.method = "tree";
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
    const std::size_t first = out.lights.size();
    out.levels.push_back(static_cast<std::uint32_t>(first));
    out.lights.insert(out.lights.end(), level->begin(), level->end());
    for (std::size_t i = 0; i < level->size() && level + 1 != levels.rend(); ++i)
      out.lights[first + i].children = static_cast<std::uint32_t>(first + level->size() + 4 * i);
  }
  out.levels.push_back(static_cast<std::uint32_t>(out.lights.size()));
  return out;
}

// Every other bit of x.
inline int even_bits(int x) {
  int out = 0;
  for (int bit = 0; bit < 15; ++bit) out |= (x >> (2 * bit) & 1) << bit;
  return out;
}

// 4^levels points of the floor, [-0.9, 0.9]^2, in Morton order.
inline Lights lit_floor(const scene::Scene& scene, int levels) {
  std::vector<interop::Light> leaves;
  const int side = 1 << levels;
  for (int i = 0; i < side * side; ++i) {
    const auto place = [&](int k) { return 1.8 * (k + 0.5) / side - 0.9; };
    leaves.push_back(make_light({place(even_bits(i)), place(even_bits(i >> 1)), 0}, {0, 0, 1}));
  }
  return make_tree(scene, std::move(leaves));
}

}  // namespace vsgl::test
