#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "math/frame.h"
#include "math/vec.h"

// Quadratures over intervals and over the sphere.

namespace vsgl::test {

inline constexpr double pi = std::numbers::pi;

// visit(x, weight) for the nodes of Gauss' rule over [from, to]: exact to degree 59.
template <class Visit>
void for_each_node(double from, double to, Visit visit) {
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  const double half = (to - from) / 2;
  for (std::size_t n = 0; n < Gauss::abscissa().size(); ++n)
    for (const double side : {-1.0, 1.0})
      visit(from + half + side * half * Gauss::abscissa()[n], half * Gauss::weights()[n]);
}

// visit(direction, weight): exact for polynomials of degree 31.
template <class Visit>
void for_each_direction(Visit visit) {
  for_each_node(-1, 1, [&](double z, double weight) {
    for (int a = 0; a < 32; ++a) {
      const double r = std::sqrt(1 - z * z), azimuth = 2 * pi * (a + 0.5) / 32;
      visit(Vec3{r * std::cos(azimuth), r * std::sin(azimuth), z}, weight * 2 * pi / 32);
    }
  });
}

}  // namespace vsgl::test
