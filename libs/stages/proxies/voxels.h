#pragma once

// A mesh's inside as voxels.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "stages/proxies/sphere_set.h"

namespace vsgl::proxies {

// Of nx x ny x nz voxels, x fastest: those of a mesh's box, and about them a margin in which a ball of their
// volume about any of the box's points has room.
struct Voxels {
  Vec3 low;
  double side = 0;
  std::size_t of_box = 0;
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

  // first..last along an axis; nothing where last < first.
  struct Span {
    int first = 0, last = -1;
  };
  // What a sphere may reach, and the voxels of a row along x whose centres it holds.
  Span slices_of(const Sphere& sphere) const { return reach(sphere.center.z, sphere.radius, low.z, nz); }
  Span rows_of(const Sphere& sphere) const { return reach(sphere.center.y, sphere.radius, low.y, ny); }
  Span row_in(const Sphere& sphere, int y, int z) const;
  // Calls visit(index) for the voxels whose centres a sphere holds.
  template <class Visit>
  void for_each_in(const Sphere& sphere, Visit visit) const;

 private:
  // Of `count` voxels from `origin`, those whose centres lie within `radius` of `at`.
  Span reach(double at, double radius, double origin, int count) const {
    return {std::max(static_cast<int>(std::ceil((at - radius - origin) / side - 0.5)), 0),
            std::min(static_cast<int>(std::floor((at + radius - origin) / side - 0.5)), count - 1)};
  }
};

// About cells^3 voxels in the mesh's box; less where that were more than 256 along the longest side. A voxel
// is inside where the mesh winds round its centre along at least two of the three axes: a hole along one of
// them does no harm.
Voxels voxelise(const Triangles& triangles, int cells);

// Squared distance (of centres, in voxels) from each inside voxel to the nearest one outside; 0 outside.
// [Felzenszwalb 2012]
std::vector<float> squared_distances(const Voxels& voxels);

inline Voxels::Span Voxels::row_in(const Sphere& sphere, int y, int z) const {
  const Vec3 d = center(0, y, z) - sphere.center;
  const double rest = sphere.radius * sphere.radius - d.y * d.y - d.z * d.z;
  return rest < 0 ? Span{} : reach(sphere.center.x, std::sqrt(rest), low.x, nx);
}

template <class Visit>
void Voxels::for_each_in(const Sphere& sphere, Visit visit) const {
  const Span rows = rows_of(sphere), slices = slices_of(sphere);
  for (int z = slices.first; z <= slices.last; ++z)
    for (int y = rows.first; y <= rows.last; ++y) {
      const Span row = row_in(sphere, y, z);
      for (int x = row.first; x <= row.last; ++x) visit(index(x, y, z));
    }
}

}  // namespace vsgl::proxies
