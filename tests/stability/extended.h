#pragma once

#include <cmath>
#include <numbers>

#include "math/vec.h"

// Exact values for float32 arguments: the plain formulas in extended precision (64-bit mantissa), where
// nothing that matters here cancels.

namespace vsgl::test {

struct ExtendedVec3 {
  long double x, y, z;

  friend ExtendedVec3 operator+(ExtendedVec3 a, ExtendedVec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend ExtendedVec3 operator-(ExtendedVec3 a, ExtendedVec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend ExtendedVec3 operator*(long double s, ExtendedVec3 a) { return {s * a.x, s * a.y, s * a.z}; }
};
inline ExtendedVec3 extend(Vec3 v) {
  return {v.x, v.y, v.z};
}
inline long double dot(ExtendedVec3 a, ExtendedVec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline long double length(ExtendedVec3 a) {
  return std::sqrt(dot(a, a));
}
inline ExtendedVec3 normalise(ExtendedVec3 a) {
  return (1 / length(a)) * a;
}

inline constexpr long double extended_pi = std::numbers::pi_v<long double>;

// (2 pi / l)(1 - e^(-2 l)).
inline long double extended_sg_integral(long double l) {
  return l == 0 ? 4 * extended_pi : -2 * extended_pi / l * std::expm1(-2 * l);
}

// Sharpness and exponent of the product of two SGs.
struct ExtendedProduct {
  long double sharpness, exponent;
};
inline ExtendedProduct extended_product(ExtendedVec3 axis1, long double l1, ExtendedVec3 axis2,
                                        long double l2) {
  const long double sharpness = length(l1 * axis1 + l2 * axis2);
  return {sharpness, sharpness - l1 - l2};
}

// Integral over the sphere of a VSGL's light of unit amplitude, 1/m^2: the product of the emission lobe and
// the footprint's, over 2 pi variance. [Tokuyoshi 2016, Eqs. (11)-(12)]
inline long double extended_fluence(Vec3 v, long double variance, Vec3 axis, long double sharpness) {
  const ExtendedVec3 to_light = extend(v);
  const long double d2 = dot(to_light, to_light);
  const ExtendedVec3 emission = normalise(extend(axis));
  const ExtendedVec3 u = d2 > 0 ? normalise(to_light) : -1 * emission;
  if (variance == 0) return std::exp(sharpness * (dot(u, -1 * emission) - 1)) / d2;
  const ExtendedProduct product = extended_product(u, d2 / variance, -1 * emission, sharpness);
  return std::exp(product.exponent) * extended_sg_integral(product.sharpness) / (2 * extended_pi * variance);
}

}  // namespace vsgl::test
