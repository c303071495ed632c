#include "sh/proxy_sphere.h"

#include <algorithm>

namespace vsgl::sh {

SeenSphere above_plane(SeenSphere sphere, Vec3 normal) {
  const double height = dot(sphere.center, normal), radius = sphere.radius;
  if (height + radius <= 0 || (height <= 0 && length(sphere.center) < radius)) return {};
  if (std::abs(height) >= radius) return sphere;
  // The sphere inscribed between the plane and the top of the one that it cuts; below half, it shrinks
  // towards the circle of the cut.
  const Vec3 foot = sphere.center - height * normal;
  double inscribed = (radius + height) / 2;
  if (height <= 0) {
    const double circle = std::sqrt(std::max(radius * radius - height * height, 0.0));
    inscribed *= std::clamp((length(foot) - circle) / std::max(circle, 1e-300), 0.0, 1.0);
  }
  return {foot + inscribed * normal, inscribed};
}

}  // namespace vsgl::sh
