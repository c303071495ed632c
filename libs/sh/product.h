#pragma once

// Products of functions given by their spherical harmonics, projected to the same order.

#include <vector>

#include "sh/basis.h"

namespace vsgl::sh {

// Integral of y_i y_j y_k.
struct Triple {
  int i = 0, j = 0, k = 0;  // i <= j <= k
  double value = 0;
};
// All that are not 0: 77, by a quadrature that is exact.
const std::vector<Triple>& triples();

// [Sloan 2007, Section 3] f * g. Not associative: what lies beyond the order is cut off each time.
Vector product(const Vector& f, const Vector& g);

using Matrix = std::array<Vector, kCoefficients>;
// The symmetric matrix of the multiplication by f: product(f, g) = multiplier(f) g.
Matrix multiplier(const Vector& f);

}  // namespace vsgl::sh
