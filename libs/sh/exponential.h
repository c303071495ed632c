#pragma once

// Logarithms and exponentials in the algebra of SH products: products of many occlusions as sums.

#include <string>

#include "sh/product.h"

namespace vsgl::sh {

// [Ren 2006] log of g = 1 - cap(below): f = R q(D) R^T (g - 1) with the multiplier R D R^T of
// g and q(x) = ln(x') / (x' - 1), x' = max(x, 0.02 max D). below: 0..1.
Zonal log_occlusion(double below);

// exp of f, where f sums logarithms of occlusions, by one of
//   second-order  1 + x + x*x/2 of x = f / 2^p, ||x|| <= 1/2, squared p times
//   hyb           [Ren 2006] a 1 + b x of ||x|| <= 1/4, a and b fitted to single caps, squared p times
// each with f's constant part taken out beforehand, exactly. At most 16 squarings.
Vector exp_second_order(const Vector& f);
Vector exp_hyb(const Vector& f);
// By the exponential of the multiplier of f, applied to 1: exact but for rounding.
Vector exp_exact(const Vector& f);

// [Ren 2006] the factors of HYB for a vector without constant part of norm m, 0..1/4.
struct LinearFit {
  double constant = 1, linear = 1;
};
LinearFit linear_fit(double norm);

inline constexpr double kSecondOrderNorm = 0.5, kHybNorm = 0.25;
inline constexpr int kMaxSquarings = 16;
// Smallest p with norm / 2^p <= limit, at most kMaxSquarings.
int squarings(double norm, double limit);

}  // namespace vsgl::sh
