#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/fvpl.h"
#include "math/microfacet.h"

namespace vsgl {
namespace {

constexpr double kPi = std::numbers::pi;

// Integral over the hemisphere of density times cosine, by slopes: r = tan, x = r^2.
TEST(GgxSpread, IsNormalised) {
  for (const double alpha2 : {1e-4, 0.01, 0.25, 1.0})
    for (const double spread : {0.0, 1e-3, 0.1, 1.0}) {
      double sum = 0;
      constexpr int kSteps = 20000;
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps, scale = alpha2 + spread, x = scale * t / (1 - t);  // 0..infinity
        const double cos2 = 1 / (1 + x);
        const double density = ggx_spread_d(alpha2, spread, x * cos2, cos2);
        sum += kPi * density * cos2 * cos2 * scale / ((1 - t) * (1 - t) * kSteps);
      }
      EXPECT_NEAR(sum, 1, 1e-3) << alpha2 << " " << spread;
    }
}

TEST(GgxSpread, IsGgxWithoutSpread) {
  for (const double alpha2 : {1e-4, 0.04, 1.0})
    for (const double sin2 : {0.0, 0.01, 0.5, 0.9})
      EXPECT_NEAR(ggx_spread_d(alpha2, 0, sin2, 1 - sin2) / ggx_d(alpha2, sin2, 1 - sin2), 1, 1e-12);
}

// GGX in slopes (x, y), convolved with a Gaussian of variance spread / 2 an axis.
double convolved(double alpha2, double spread, double x) {
  const double deviation = std::sqrt(spread / 2), step = deviation / 40;
  double sum = 0, weight = 0;
  for (double i = -5 * deviation; i <= 5 * deviation; i += step)
    for (double j = -5 * deviation; j <= 5 * deviation; j += step) {
      const double w = std::exp(-(i * i + j * j) / spread), q = alpha2 + (x - i) * (x - i) + j * j;
      sum += w * alpha2 / (kPi * q * q);
      weight += w;
    }
  return sum / weight;
}

// Far from the highlight, where GGX of alpha^2 + spread is too bright by the spread over alpha^2.
TEST(GgxSpread, KeepsItsTail) {
  const double alpha2 = 0.01;
  for (const double spread : {0.001, 0.003})
    for (const double x : {0.3, 0.6, 1.0}) {
      const double cos2 = 1 / (1 + x * x), exact = convolved(alpha2, spread, x);
      const double slope_density = ggx_spread_d(alpha2, spread, x * x * cos2, cos2) * cos2 * cos2;
      EXPECT_NEAR(slope_density / exact, 1, 0.02) << spread << " " << x;
    }
}

TEST(GgxSpread, HasThePeakOfTheConvolution) {
  for (const double alpha2 : {0.01, 0.1})
    for (const double spread : {0.02 * alpha2, 0.1 * alpha2, alpha2, 10 * alpha2})
      EXPECT_NEAR(ggx_spread_d(alpha2, spread, 0, 1) / convolved(alpha2, spread, 0), 1, 0.25)
          << alpha2 << " " << spread;
}

}  // namespace
}  // namespace vsgl
