#pragma once

#include <array>
#include <cstdint>

#include "math/vec.h"

// Monte Carlo over the cone of a virtual spherical light, in double precision: the twin of
// shaders/lib/vsl.glsl.

namespace vsgl {

// 1 - cos of the half angle of the cone in which a light of squared radius `radius2` is seen from squared
// distance `d2`. [Tokuyoshi 2014, Sec. 3.1] a disk that faces the receiver: 0..1.
double disk_cone_height(double d2, double radius2);
// [Hasan 2009] the sphere itself: 0..1; 2, all directions, from inside.
double sphere_cone_height(double d2, double radius2);

// Uniform in the cone about `axis`; u in [0, 1)^2.
Vec3 cone_direction(Vec3 axis, double height, std::array<double, 2> u);

// A surface that scatters the light from `view`, as a mixture of Lambert's law and a specular lobe.
struct Scatterer {
  Vec3 view;    // unit
  Vec3 plane;   // normal of Lambert's cosine
  Vec3 normal;  // mean normal of the microfacets
  double alpha2 = 1;
  double specular = 0;  // probability of the specular lobe, 0..1
  std::uint32_t ndf = 0;
};

// Tilt of a microfacet distributed as density times cosine, as a squared sine. [Walter 2007, Eqs. (28), (31),
// (35)]
double microfacet_sin2(std::uint32_t ndf, double alpha2, double u);
// Unit direction of scattered light; zero where a microfacet faces away from `view`.
Vec3 scatter_direction(const Scatterer& s, std::array<double, 2> u);
// Its density, 1/sr.
double scatter_pdf(const Scatterer& s, Vec3 w);

}  // namespace vsgl
