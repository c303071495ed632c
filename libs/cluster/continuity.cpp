#include "cluster/continuity.h"

#include "math/interop_vec.h"

namespace vsgl {
namespace {

// A sample this far off the pixel's plane, relative to its distance, has a quarter of the weight.
constexpr double kPlaneTolerance = 0.15;

}  // namespace

double continuity(const interop::Surface& pixel, const interop::Surface& sample) {
  const Vec3 normal = to_double(pixel.normal);
  const double cosine = dot(normal, to_double(sample.normal));
  if (cosine <= 0) return 0;
  const Vec3 v = to_double(sample.position) - to_double(pixel.position);
  const double distance2 = dot(v, v), height = dot(v, normal);
  const double slope2 = distance2 > 0 ? height * height / distance2 : 0;
  const double off_plane = 1 + slope2 / (kPlaneTolerance * kPlaneTolerance);
  const double power4 = cosine * cosine * cosine * cosine, power16 = power4 * power4 * power4 * power4;
  return power16 / (off_plane * off_plane);
}

}  // namespace vsgl
