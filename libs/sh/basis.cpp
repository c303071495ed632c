#include "sh/basis.h"

#include <numbers>

namespace vsgl::sh {
namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

Vector basis(Vec3 d) {
  const double x = d.x, y = d.y, z = d.z, x2 = x * x, y2 = y * y, z2 = z * z;
  const double k0 = std::sqrt(1 / (4 * pi)), k1 = std::sqrt(3 / (4 * pi)), k2 = std::sqrt(15 / (4 * pi));
  const double k20 = std::sqrt(5 / (16 * pi)), k22 = std::sqrt(15 / (16 * pi));
  const double k30 = std::sqrt(7 / (16 * pi)), k31 = std::sqrt(21 / (32 * pi));
  const double k32 = std::sqrt(105 / (4 * pi)), k33 = std::sqrt(35 / (32 * pi));
  return {k0,
          k1 * y,
          k1 * z,
          k1 * x,
          k2 * x * y,
          k2 * y * z,
          k20 * (3 * z2 - 1),
          k2 * x * z,
          k22 * (x2 - y2),
          k33 * y * (3 * x2 - y2),
          k32 * x * y * z,
          k31 * y * (5 * z2 - 1),
          k30 * z * (5 * z2 - 3),
          k31 * x * (5 * z2 - 1),
          k32 / 2 * z * (x2 - y2),
          k33 * x * (x2 - 3 * y2)};
}

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (int i = 0; i < kCoefficients; ++i) sum += a[i] * b[i];
  return sum;
}

Vector one() {
  Vector out{};
  out[0] = std::sqrt(4 * pi);
  return out;
}

double band_factor(int l) {
  return std::sqrt(4 * pi / (2 * l + 1));
}

Vector turn(const Zonal& zonal, Vec3 axis) {
  Vector out = basis(axis);
  for (int l = 0; l < kOrder; ++l)
    for (int m = -l; m <= l; ++m) out[index(l, m)] *= band_factor(l) * zonal[l];
  return out;
}

Vector convolve(const Vector& f, const Zonal& zonal) {
  Vector out = f;
  for (int l = 0; l < kOrder; ++l)
    for (int m = -l; m <= l; ++m) out[index(l, m)] *= band_factor(l) * zonal[l];
  return out;
}

// Integrals of the Legendre polynomials from cos theta = 1 - below to 1, with below factored out of
// (P_{l-1} - P_{l+1}) / (2l + 1).
Zonal cap(double below) {
  const double c = 1 - below, wide = below * (1 + c);  // sin^2 theta
  const Zonal integrals = {below, wide / 2, c * wide / 2, wide * (5 * c * c - 1) / 8};
  Zonal out{};
  for (int l = 0; l < kOrder; ++l) out[l] = 2 * pi * integrals[l] / band_factor(l);
  return out;
}

Zonal clamped_cosine() {
  return {std::sqrt(pi) / 2, std::sqrt(pi / 3), std::sqrt(5 * pi) / 8, 0};
}

}  // namespace vsgl::sh
