#include "math/vsgl.h"

#include <algorithm>
#include <numbers>

namespace vsgl {

VsglIncoming vsgl_product(Vec3 u, double d2, double variance, Vec3 emission_axis, double emission_sharpness) {
  const double b = variance * emission_sharpness;
  const Vec3 m = d2 * u - b * emission_axis;
  const double q = length(m);
  const double sharpness = q < sharpness_max * variance ? q / variance : sharpness_max;
  const Vec3 turn = u + emission_axis;
  const double total = q + b + d2;
  const double exponent = total > 0 ? -emission_sharpness * (d2 / total) * dot(turn, turn) : 0;
  // The shader's least normal numbers bound what an infinite fluence (d = 0 and variance = 0) becomes.
  const double spread = sharpness > 0.5 ? -std::expm1(-2 * sharpness) / std::max(q, 1e-36)
                                        : 2 * phi(-2 * sharpness) / std::max(variance, 1e-36);
  return {q > 0 ? m / q : u, sharpness, exponent > -87 ? std::exp(exponent) * spread : 0};
}

VsglIncoming vsgl_incoming(Vec3 v, double variance, Vec3 emission_axis, double emission_sharpness) {
  const double d2 = dot(v, v);
  return vsgl_product(d2 > 1e-36 ? normalise(v) : -emission_axis, d2, variance, emission_axis,
                      emission_sharpness);
}

DiskCone disk_cone(double d, double radius2) {
  const double s = std::sqrt(d * d + radius2);
  const double reach = std::max(s * (s + d), 1e-36);
  const double sharpness = 2 * reach < sharpness_max * radius2 ? 2 * reach / radius2 : sharpness_max;
  return {2 * std::numbers::pi * radius2 / reach, sharpness, 2 / reach};
}

VsglIncoming vsgl_incoming_disk(Vec3 v, double variance, Vec3 emission_axis, double emission_sharpness) {
  const double d = length(v), s = std::sqrt(d * d + 4 * variance);
  const Vec3 u = d * d > 1e-36 ? v / d : -emission_axis;
  return vsgl_product(u, 0.5 * s * (s + d), variance, emission_axis, emission_sharpness);
}

}  // namespace vsgl
