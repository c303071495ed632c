#include "stages/rsm/visible.h"

#include "math/interop_vec.h"

namespace vsgl {
namespace {

struct Ray {
  Vec3 origin, direction;  // unit
  double nearest;          // m along it: the near plane
};

// The ray through a texel's centre, as shaders/rsm/view.glsl has it.
Ray texel_ray(const interop::View& view, std::uint32_t x, std::uint32_t y) {
  const double u = (2 * (x + 0.5) / view.width - 1) * static_cast<double>(view.extent_x),
               v = (1 - 2 * (y + 0.5) / view.height) * static_cast<double>(view.extent_y);
  const Vec3 origin = to_double(view.origin), forward = to_double(view.forward),
             offset = u * to_double(view.right) + v * to_double(view.up);
  if (view.kind == interop::VIEW_DIRECTIONAL) return {origin + offset, forward, 0};
  const Vec3 direction = forward + offset;
  return {origin, normalise(direction), static_cast<double>(view.near_far) * length(direction)};
}

// The index of each instance's first triangle.
std::vector<interop::uint> first_triangles(const scene::Scene& scene) {
  std::vector<interop::uint> first;
  interop::uint count = 0;
  for (const scene::Instance& instance : scene.instances) {
    first.push_back(count);
    count += static_cast<interop::uint>(instance.indices.size() / 3);
  }
  return first;
}

}  // namespace

std::vector<interop::uint> trace_visible(const scene::Scene& scene, const trace::Tracer& tracer,
                                         const interop::View& view) {
  const std::vector<interop::uint> first = first_triangles(scene);
  std::vector<interop::uint> seen(std::size_t{view.width} * view.height);
#pragma omp parallel for schedule(dynamic, 8)
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const Ray ray = texel_ray(view, x, y);
      if (const auto hit = tracer.intersect(ray.origin, ray.direction, ray.nearest))
        seen[std::size_t{y} * view.width + x] = 1 + first[hit->instance] + hit->triangle;
    }
  return seen;
}

}  // namespace vsgl
