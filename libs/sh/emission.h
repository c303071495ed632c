#pragma once

// What a sphere lit by irradiance of order 3 sends to a point outside of it.

#include "sh/basis.h"

namespace vsgl::sh {

inline constexpr int kEmissionOrder = 3;
using EmissionZonal = std::array<double, kEmissionOrder>;

// [Sloan 2007, Eq. (14)] mean of the basis over the visible part of a sphere about (0,0,1), seen from the
// origin at the half angle theta: D(theta), zonal. `sine` = sin(theta), 0..1.
// Deviation: the paper's closed form multiplied out by d + sqrt(d^2 - 1), so that nothing cancels, in place
// of the polynomials that it fits.
EmissionZonal mean_emission(double sine);

// [Sloan 2007, Eq. (16)] M(theta): the radiance of that sphere as a function of direction, in SH of order 3,
// from the irradiance, in SH of order 3. It couples coefficients of equal m only, and m and -m alike: `at(j,
// k, m)` is the coupling of band k of the irradiance to band j of the radiance.
struct EmissionMatrix {
  double couplings[kEmissionOrder][kEmissionOrder][kEmissionOrder] = {};  // |m|, j, k
  double at(int j, int k, int m) const { return couplings[m < 0 ? -m : m][j][k]; }
};
EmissionMatrix emission_matrix(double sine);

}  // namespace vsgl::sh
