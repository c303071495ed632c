#include <algorithm>
#include <limits>

#include "math/sampling.h"
#include "stages/proxies/sphere_set.h"

namespace vsgl::proxies {

double Triangles::area(std::size_t t) const {
  return length(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0))) / 2;
}

Vec3 Triangles::normal(std::size_t t) const {
  return normalise(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
}

Box bounds(const Triangles& triangles) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const std::uint32_t i : triangles.indices) {
    const Vec3 p = triangles.positions[i];
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

// Stratified along the triangles by their areas, and within them by the sequence R2 [Roberts 2018].
std::vector<SurfacePoint> surface_points(const Triangles& triangles, int count) {
  std::vector<double> upto;
  double area = 0;
  for (std::size_t t = 0; t < triangles.count(); ++t) upto.push_back(area += triangles.area(t));
  std::vector<SurfacePoint> out;
  if (!(area > 0)) return out;
  std::size_t t = 0;
  for (int i = 0; i < count; ++i) {
    while (upto[t] < area * (i + 0.5) / count) ++t;
    const auto bits = r2_bits(static_cast<std::uint32_t>(i) + 1);
    double b = bits[0] * 0x1p-32, c = bits[1] * 0x1p-32;
    if (b + c > 1) b = 1 - b, c = 1 - c;
    out.push_back({static_cast<std::uint32_t>(t), b, c});
  }
  return out;
}

Vec3 position(const Triangles& triangles, const SurfacePoint& point) {
  const Vec3 a = triangles.corner(point.triangle, 0);
  return a + point.b * (triangles.corner(point.triangle, 1) - a) +
         point.c * (triangles.corner(point.triangle, 2) - a);
}

std::size_t nearest_sphere(const std::vector<Sphere>& spheres, Vec3 point) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double distance = length(point - spheres[i].center) - spheres[i].radius;
    if (distance < least) least = distance, best = i;
  }
  return best;
}

double signed_distance(const std::vector<Sphere>& spheres, Vec3 point) {
  const Sphere& sphere = spheres[nearest_sphere(spheres, point)];
  return length(point - sphere.center) - sphere.radius;
}

}  // namespace vsgl::proxies
