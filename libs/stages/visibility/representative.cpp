#include "stages/visibility/representative.h"

#include <cmath>

#include "math/interop_vec.h"

namespace vsgl::visibility {

trace::SurfacePoint representative(const interop::Light& light, double scene_radius,
                                   const trace::Tracer& tracer) {
  const Vec3 origin = to_double(light.origin), mean_normal = to_double(light.normal);
  if (light.normal_deficit == 0) return {origin, mean_normal};
  const Vec3 incident = to_double(light.incident);
  const double step = 1e-4 * scene_radius;
  const auto hit = tracer.intersect(origin + step * incident, -incident);
  if (!hit || std::abs(hit->distance - step) > 0.1 * step) return {origin, mean_normal};
  return {origin, to_double(tracer.surface(*hit, incident).normal)};
}

}  // namespace vsgl::visibility
