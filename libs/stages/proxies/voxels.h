#pragma once

// A mesh's inside as voxels.

#include <cstdint>
#include <vector>

#include "stages/proxies/sphere_set.h"

namespace vsgl::proxies {

// Of nx x ny x nz voxels, x fastest; the outermost ones are outside.
struct Voxels {
  Vec3 low;
  double side = 0;
  int nx = 0, ny = 0, nz = 0;
  std::vector<std::uint8_t> inside;  // 1: inside

  std::size_t size() const { return inside.size(); }
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(x);
  }
  Vec3 center(int x, int y, int z) const { return low + side * Vec3{x + 0.5, y + 0.5, z + 0.5}; }
  std::size_t inside_count() const;

  // Calls visit(index) for the voxels whose centres a sphere holds.
  template <class Visit>
  void for_each_in(const Sphere& sphere, Visit visit) const;
};

// The mesh's box at `cells` voxels along its longest side. A voxel is inside where the mesh winds round its
// centre along at least two of the three axes: a hole along one of them does no harm.
Voxels voxelise(const Triangles& triangles, int cells);

// Squared distance (of centres, in voxels) from each inside voxel to the nearest one outside; 0 outside.
// [Felzenszwalb 2012]
std::vector<float> squared_distances(const Voxels& voxels);

template <class Visit>
void Voxels::for_each_in(const Sphere& sphere, Visit visit) const {
  const auto first = [&](double from, double origin) {
    return std::max(static_cast<int>(std::floor((from - origin) / side - 0.5)), 0);
  };
  const auto last = [&](double to, double origin, int count) {
    return std::min(static_cast<int>(std::ceil((to - origin) / side - 0.5)), count - 1);
  };
  const Vec3 c = sphere.center;
  const double r = sphere.radius;
  for (int z = first(c.z - r, low.z); z <= last(c.z + r, low.z, nz); ++z)
    for (int y = first(c.y - r, low.y); y <= last(c.y + r, low.y, ny); ++y)
      for (int x = first(c.x - r, low.x); x <= last(c.x + r, low.x, nx); ++x) {
        const Vec3 d = center(x, y, z) - c;
        if (dot(d, d) <= r * r) visit(index(x, y, z));
      }
}

}  // namespace vsgl::proxies
