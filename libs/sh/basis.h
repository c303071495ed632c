#pragma once

// Real spherical harmonics of order 4: 16 coefficients, (l, m) at index l^2 + l + m, without the
// Condon-Shortley phase: y_00 = 1/(2 sqrt(pi)), and y_1m is a positive multiple of (y, z, x). In double
// precision; docs/proxies.md states the formulas.

#include <array>

#include "math/vec.h"

namespace vsgl::sh {

inline constexpr int kOrder = 4, kCoefficients = kOrder * kOrder;

using Vector = std::array<double, kCoefficients>;
// Coefficients of a function that is symmetric about z: those of m = 0, one a band.
using Zonal = std::array<double, kOrder>;

inline constexpr int index(int l, int m) {
  return l * l + l + m;
}

// y_lm of a unit direction.
Vector basis(Vec3 direction);
double dot(const Vector& a, const Vector& b);
// The constant function 1.
Vector one();

// sqrt(4 pi / (2l + 1)), by which a zonal function is turned and convolved.
double band_factor(int l);
// [Sloan 2007, Eq. (8)] the zonal function turned so that its axis is `axis` (unit).
Vector turn(const Zonal& zonal, Vec3 axis);
// [Sloan 2007, Eq. (7)] convolution of a function with a zonal one.
Vector convolve(const Vector& f, const Zonal& zonal);

// A cap about z of half angle theta, 0..pi, that is 1 within and 0 outside; `below` = 1 - cos theta, exact
// for narrow caps. [Sloan 2007, Eq. (3)]
Zonal cap(double below);
// max(0, cos) about z. [Sloan 2007, Section 3]
Zonal clamped_cosine();

// 1 - cos(theta) of sin(theta) = `sine`, 0..1, without cancellation. [Sloan 2007, Eq. (2)]
inline double below_of_sine(double sine) {
  return sine * sine / (1 + std::sqrt(std::fmax(1 - sine * sine, 0.0)));
}

}  // namespace vsgl::sh
