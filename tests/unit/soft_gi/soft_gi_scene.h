#pragma once

// Receivers, skies and proxies placed by hand.

#include <cmath>
#include <numbers>
#include <vector>

#include "../synthetic_scene.h"
#include "stages/soft_gi/light.h"
#include "stages/soft_gi/soft_gi.h"

namespace vsgl::test {

inline constexpr double pi = std::numbers::pi;

inline gpu::Device& device() {
  static gpu::Device instance({.compute_only = true});
  return instance;
}

struct Point {
  Vec3 position, normal;
};

// A row of white pixels, or an image of so many columns.
inline GBuffer gbuffer_of(const std::vector<Point>& points, int columns = 0) {
  GBuffer out;
  out.width = columns > 0 ? columns : static_cast<int>(points.size());
  out.height = static_cast<int>(points.size()) / out.width;
  out.camera = {0, 0, 10};
  for (const Point& point : points) {
    interop::Surface pixel{};
    pixel.position = narrow(point.position);
    pixel.normal = pixel.shading_normal = narrow(normalise(point.normal));
    pixel.diffuse = {1, 1, 1};
    pixel.alpha = 1;
    pixel.depth = static_cast<float>(length(point.position - out.camera));
    out.pixels.push_back(pixel);
  }
  return out;
}

template <class Radiance>
scene::Environment sky_of(Radiance radiance, int height = 32) {
  scene::Environment sky{2 * height, height, {}, {}};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < sky.width; ++column)
      sky.radiance.push_back(
          radiance(scene::environment_direction((column + 0.5) / sky.width, (row + 0.5) / height)));
  return sky;
}
inline scene::Environment even_sky() {
  return sky_of([](Vec3) { return Vec3{1, 1, 1}; });
}
// Bluish from above, reddish from one side, all smooth, with parts of all the basis' functions of order 3.
inline scene::Environment coloured_sky() {
  return sky_of([](Vec3 d) {
    return Vec3{1 + 0.9 * d.x + 0.1 * d.z, 1 + 0.5 * d.y * d.z - 0.4 * d.x * d.z,
                1.2 + d.y + 0.4 * d.x * d.x + 0.4 * d.x * d.y};
  });
}

inline Proxies proxies_of(std::vector<ProxySphere> spheres) {
  Proxies out;
  out.objects.push_back({"object", 0, false, {}, std::move(spheres)});
  return out;
}

inline Indirect shade(const GBuffer& gbuffer, const Proxies& proxies, const scene::Environment& sky,
                      SoftGiParams params = {}, Occlusion* occlusion = nullptr) {
  Report report;
  return shade_soft_gi(gbuffer, proxies, sky, params, device(), report, occlusion);
}
// At every pixel, with far reaching spheres of influence.
inline SoftGiParams everywhere() {
  SoftGiParams params;
  params.rate = 1;
  params.shadow_influence = params.indirect_influence = 1000;
  return params;
}
// The same, with overlaps as the paper has them.
inline SoftGiParams as_published() {
  SoftGiParams params = everywhere();
  params.normalisation = "solid-angle";
  params.overlap = "whole";
  return params;
}

}  // namespace vsgl::test
