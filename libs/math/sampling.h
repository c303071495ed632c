#pragma once

// Sample points and hierarchical sample warping: the double-precision twin of shaders/lib/sampling.glsl.
// Integer parts agree with it bit by bit. Also what only the host does: the search for lattices and the mean
// pyramids of densities.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "interop/sampling.h"
#include "math/pyramid.h"

namespace vsgl {

// A view of a mean pyramid (math/pyramid.h) of a density over size x size texels.
struct DensityPyramid {
  int size = 0;
  std::span<const float> texels;

  int top() const { return pyramid_levels(size) - 1; }
  double at(int level, int i, int j) const {
    return texels[pyramid_offset(size, level) +
                  static_cast<std::size_t>(j) * static_cast<std::size_t>(size >> level) +
                  static_cast<std::size_t>(i)];
  }
  double mean() const { return texels.back(); }
};

// All levels of level 0's means: each texel is the mean of the 2x2 texels below it, added in the order 00,
// 10, 01, 11.
std::vector<float> mean_pyramid(std::span<const float> level0, int size);

// "lattice", "fibonacci", "random"; throws bad_value for other names.
std::vector<std::string> point_set_names();
std::uint32_t point_set_kind(const std::string& name);

// A set of `count` points, 1..MAX_POINTS, of that kind (POINTS_*). The
// seed shapes random points and the rotation of the others. Lattices of fewer than 8 points are Fibonacci's:
// there is nothing to search.
interop::PointSet make_point_set(std::uint32_t kind, std::uint32_t count, std::uint64_t seed);

// The generator of the rank-1 lattice (i / count, frac(i g / count)) whose shortest vector on the torus is
// longest, jointly with that of its sub-lattices i = s mod 16 where 16 divides count (each in units of the
// square's mean spacing). Exact, in integers; the smallest such g.
std::uint32_t lattice_generator(std::uint32_t count);
// Squared length of the lattice's shortest vector, in units of 1 / count.
std::uint64_t lattice_shortest_squared(std::uint32_t count, std::uint32_t generator);

std::array<std::uint32_t, 3> pcg3d(std::array<std::uint32_t, 3> v);
// [Roberts 2018] point k of the sequence R2, in 32-bit fixed point.
std::array<std::uint32_t, 2> r2_bits(std::uint32_t k);
// Point i, in 32-bit fixed point and as [0,1)^2 (the upper 24 bits).
std::array<std::uint32_t, 2> point_bits(const interop::PointSet& set, std::uint32_t i);
std::array<double, 2> point(const interop::PointSet& set, std::uint32_t i);

// A point warped to the texel (i, j) of a layer; x, y: its position in the layer, [0,1)^2.
struct WarpedPoint {
  int layer = 0, i = 0, j = 0;
  double x = 0, y = 0;
};
// [Clarberg 2005] with the layers chosen first, in proportion to their means. Some density must be positive.
WarpedPoint warp(std::span<const DensityPyramid> layers, std::array<double, 2> point);

}  // namespace vsgl
