#pragma once

// Spheres that approximate one mesh, in the mesh's own coordinates.

#include <array>
#include <cstdint>
#include <vector>

#include "math/vec.h"

namespace vsgl::proxies {

struct Sphere {
  Vec3 center;
  double radius = 0;
};

struct Triangles {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;

  std::size_t count() const { return indices.size() / 3; }
  Vec3 corner(std::size_t triangle, int k) const { return positions[indices[3 * triangle + k]]; }
  double area(std::size_t triangle) const;
  Vec3 normal(std::size_t triangle) const;  // unit, of its front; 0 without area
};

struct Box {
  Vec3 low, high;
};
Box bounds(const Triangles& triangles);

// A point of a triangle: corner 0 + b (corner 1 - corner 0) + c (corner 2 - corner 0).
struct SurfacePoint {
  std::uint32_t triangle = 0;
  double b = 0, c = 0;
};
// Evenly spread over the area, always the same ones. None where there is no area.
std::vector<SurfacePoint> surface_points(const Triangles& triangles, int count);
Vec3 position(const Triangles& triangles, const SurfacePoint& point);

struct SphereSet {
  std::vector<Sphere> spheres;
  bool sheet = false;
  double volume_outside = 0, volume_missed = 0;  // over the mesh's volume
};
// At most `count` spheres; none for a mesh without area.
SphereSet fit_spheres(const Triangles& triangles, int count, double cover, double overlap_cost);

// Distance of a point to the surface of the spheres' union: negative inside.
double signed_distance(const std::vector<Sphere>& spheres, Vec3 point);
// Whose surface is nearest, counted from its centre outwards; there must be one.
std::size_t nearest_sphere(const std::vector<Sphere>& spheres, Vec3 point);

}  // namespace vsgl::proxies
