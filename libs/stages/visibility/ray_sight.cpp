#include "stages/visibility/ray_sight.h"

#include "math/interop_vec.h"
#include "stages/visibility/representative.h"

namespace vsgl::visibility {

std::vector<interop::vec3> representative_normals(const Lights& lights, const trace::Tracer& tracer) {
  std::vector<interop::vec3> normals(lights.lights.size());
#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t i = 0; i < normals.size(); ++i)
    normals[i] = to_float(representative(lights.lights[i], lights.scene_radius, tracer).normal);
  return normals;
}

Seen RaySight::see(std::span<const Pair> pairs) const {
  trace::PointPacket nodes, pixels;
  Seen seen;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Point* point = facing_point(pairs[i]);
    if (point == nullptr) continue;
    nodes.set(i, point->position, point->normal);
    pixels.set(i, pixel(pairs[i]).position, pixel(pairs[i]).normal);
    seen.facing |= 1U << i;
  }
  if (seen.facing != 0) seen.visible = seen.facing & ~tracer_.occluded(nodes, pixels, seen.facing);
  return seen;
}

}  // namespace vsgl::visibility
