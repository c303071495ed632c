#include "math/sg.h"

#include <algorithm>
#include <numbers>

namespace vsgl {
namespace {

constexpr double pi = std::numbers::pi;

// Integrals over the sphere of the SG times max(w.n, 0) at c = 1 (up) and c = -1 (low), over 2 pi.
struct CosineEnds {
  double up, low;
};

CosineEnds cosine_ends(double l) {
  if (l > 0.5) {
    const double p = phi(-l), e = std::exp(-l);
    return {(1 - p) / l, e * (p - e) / l};
  }
  // up = sum of (-l)^k / (k + 2)!, low = e^-l sum of (-l)^k / ((k + 2) k!).
  double up = 0, low = 0, power = 1;  // power: (-l)^k / k!
  for (int k = 0; k < 12; ++k) {
    up += power / ((k + 1) * (k + 2));
    low += power / (k + 2);
    power *= -l / (k + 1);
  }
  return {up, low * std::exp(-l)};
}

}  // namespace

double phi(double x) {
  return x == 0 ? 1 : std::expm1(x) / x;
}

double sg_value(Vec3 w, Vec3 axis, double sharpness) {
  const Vec3 d = w - axis;
  return std::exp(-0.5 * sharpness * dot(d, d));
}

double sg_integral(double sharpness) {
  return 4 * pi * phi(-2 * sharpness);
}

SgProduct sg_product(Vec3 axis1, double sharpness1, Vec3 axis2, double sharpness2) {
  const Vec3 sum = axis1 + axis2, difference = axis1 - axis2;
  const double gap = sharpness1 - sharpness2;
  const double sharpness = std::sqrt(gap * gap + sharpness1 * sharpness2 * dot(sum, sum));
  const double total = sharpness + sharpness1 + sharpness2;
  const Vec3 m = normalise(sharpness1 * axis1 + sharpness2 * axis2);
  const double exponent = total > 0 ? -sharpness1 * (sharpness2 / total) * dot(difference, difference) : 0;
  return {m == Vec3{} ? axis1 : m, sharpness, exponent};
}

double vmf_hemisphere(double c, double sharpness) {
  const double l = sharpness;
  const double s = l * std::sqrt((0.5 * l + 0.6517328827) / ((l + 1.3418280033) * l + 7.2216687798));
  const double t = s > 0 ? std::clamp(0.5 + 0.5 * std::erf(s * c) / std::erf(s), 0.0, 1.0) : 0.5 * (1 + c);
  const double e = std::exp(-l);
  return (e + (1 - e) * t) / (1 + e);
}

double cosine_mean(double c, double sharpness) {
  const double l = sharpness;
  if (l == 0) return 0.25;
  c = std::clamp(c, -1.0, 1.0);  // unit vectors of float32 may be longer, and l makes much of it
  const double numerator = (l + 2.7360831611) * l + 17.0212977817;
  const double denominator = 2 * (((l + 4.0100826729) * l + 15.2191562631) * l + 76.0878962724);
  const double t = l * std::sqrt(numerator / denominator);
  const double peak = std::exp(-t * t * c * c) * std::expm1(-t * t * (1 - c * c));
  const double f = 0.5 * (c * std::erfc(-t * c) + std::erfc(t)) - peak / (2 * std::sqrt(pi) * t);
  const CosineEnds ends = cosine_ends(l);
  return (ends.low + (ends.up - ends.low) * std::clamp(f, 0.0, 1.0)) / (2 * phi(-2 * l));
}

double cosine_integral(double c, double sharpness) {
  return sg_integral(sharpness) * cosine_mean(c, sharpness);
}

}  // namespace vsgl
