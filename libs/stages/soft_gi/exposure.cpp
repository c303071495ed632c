#include "stages/soft_gi/exposure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/frame.h"
#include "stages/soft_gi/directions.h"

namespace vsgl::soft_gi {
namespace {

constexpr int kDirections = 64, kRays = 32;  // rays of each direction
constexpr int kLevels = interop::PROXY_EXPOSURES;

// Up to which distance of the centres a neighbour counts.
double reach(const ProxySphere& sphere, int level) {
  return kNeighbourhood * std::ldexp(sphere.radius, level);
}

struct Neighbour {
  Vec3 center;  // from the sphere's
  double radius, distance;
};

std::vector<Neighbour> neighbours_of(const std::vector<ProxySphere>& spheres, std::size_t which) {
  std::vector<Neighbour> out;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Vec3 center = spheres[i].center - spheres[which].center;
    if (i != which && length(center) <= reach(spheres[which], kLevels - 1))
      out.push_back({center, spheres[i].radius, length(center)});
  }
  return out;
}

// What lies before the sphere along one ray.
struct Ahead {
  double distance = std::numeric_limits<double>::infinity();  // of the nearest neighbour that does
  int equals = 1;                                             // spheres that coincide with this one
};

// Rays along z, in the frame of the ray's direction, through (x, y); -depth: where they meet the sphere.
Ahead look(const std::vector<Neighbour>& neighbours, double x, double y, double depth, double radius) {
  Ahead out;
  for (const Neighbour& n : neighbours) {
    const double dx = x - n.center.x, dy = y - n.center.y, inside = n.radius * n.radius - dx * dx - dy * dy;
    if (n.distance == 0 && n.radius == radius)
      ++out.equals;
    else if (inside > 0 && n.center.z - std::sqrt(inside) < -depth)
      out.distance = std::min(out.distance, n.distance);
  }
  return out;
}

Exposure exposure_of(const ProxySphere& sphere, const std::vector<Neighbour>& neighbours) {
  std::array<double, kLevels> sums{};
  for (const Vec3 direction : directions(kDirections)) {
    const Frame frame = frame_about(direction);
    std::vector<Neighbour> near;
    for (const auto& [center, radius, distance] : neighbours) {
      const Vec3 local = frame.to_local(center);
      if (std::hypot(local.x, local.y) < sphere.radius + radius) near.push_back({local, radius, distance});
    }
    for (int i = 0; i < kRays; ++i) {
      const double share = (i + 0.5) / kRays, r = sphere.radius * std::sqrt(share);
      const double azimuth = 2 * std::numbers::pi * std::numbers::phi * i;
      const Ahead ahead = look(near, r * std::cos(azimuth), r * std::sin(azimuth),
                               sphere.radius * std::sqrt(1 - share), sphere.radius);
      for (int level = 0; level < kLevels; ++level)
        if (ahead.distance > reach(sphere, level)) sums[level] += 1.0 / ahead.equals;
    }
  }
  Exposure out;
  for (int level = 0; level < kLevels; ++level)
    out[level] = static_cast<float>(sums[level] / (kDirections * kRays));
  return out;
}

}  // namespace

std::vector<Exposure> exposures(const std::vector<ProxySphere>& spheres) {
  std::vector<Exposure> out(spheres.size());
#pragma omp parallel for schedule(dynamic, 4)
  for (std::size_t i = 0; i < spheres.size(); ++i)
    out[i] = exposure_of(spheres[i], neighbours_of(spheres, i));
  return out;
}

}  // namespace vsgl::soft_gi
