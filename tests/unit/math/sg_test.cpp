#include "math/sg.h"

#include <gtest/gtest.h>

#include "quadrature.h"

namespace vsgl {
namespace {

using test::pi;

Vec3 at_angle(double angle) {
  return {std::sin(angle), 0, std::cos(angle)};
}

TEST(Sg, IntegralMatchesQuadratureAndLimits) {
  EXPECT_DOUBLE_EQ(sg_integral(0), 4 * pi);
  EXPECT_NEAR(sg_integral(1e-9) / (4 * pi * (1 - 1e-9)), 1, 1e-15);
  EXPECT_NEAR(sg_integral(1e8) * 1e8 / (2 * pi), 1, 1e-15);
  for (const double l : {0.3, 2.2925, 40.0}) {
    double sum = 0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) sum += std::exp(l * (2 * (i + 0.5) / count - 2));
    EXPECT_NEAR(4 * pi * sum / count / sg_integral(l), 1, 1e-5) << l;
  }
}

TEST(Sg, ProductHoldsPointwise) {
  const Vec3 a = normalise(Vec3{1, 2, -0.5});
  const Vec3 b = normalise(Vec3{-0.7, 0.4, 1});
  for (const double l1 : {0.0, 0.5, 30.0})
    for (const double l2 : {0.0, 3.0, 100.0}) {
      const SgProduct p = sg_product(a, l1, b, l2);
      for (const Vec3 w : {a, b, at_angle(0.3), at_angle(2), normalise(a + b)})
        EXPECT_NEAR(std::log(sg_value(w, a, l1) * sg_value(w, b, l2)),
                    p.exponent + std::log(sg_value(w, p.axis, p.sharpness)), 1e-11);
    }
}

TEST(Sg, ProductKeepsItsDigitsForSharpLobes) {
  // Two lobes of sharpness l at a small angle t: exponent -l t^2 / 4 (1 + O(t^2)).
  for (const double l : {1e4, 1e8, 1e12}) {
    const double t = 1 / std::sqrt(l);
    const SgProduct p = sg_product(at_angle(0), l, at_angle(t), l);
    EXPECT_NEAR(p.exponent, -0.25, 1e-4);
    EXPECT_NEAR(p.sharpness / (2 * l), 1, 1e-4);
  }
  const SgProduct opposite = sg_product({0, 0, 1}, 5, {0, 0, -1}, 5);
  EXPECT_EQ(opposite.sharpness, 0);
  EXPECT_DOUBLE_EQ(opposite.exponent, -10);
  EXPECT_EQ(sg_product({0, 0, 1}, 0, {1, 0, 0}, 0).exponent, 0);
}

// Largest error over angles 0..180 degrees, over the peak.
template <class Approximation>
double worst_error(double sharpness, int power, Approximation approximation) {
  double worst = 0, peak = test::vmf_mean_above(1, sharpness, power);
  for (int degrees = 0; degrees <= 180; degrees += 9) {
    const double c = std::cos(degrees * pi / 180);
    worst =
        std::max(worst, std::abs(approximation(c, sharpness) - test::vmf_mean_above(c, sharpness, power)));
  }
  return worst / peak;
}

TEST(Sg, HemisphericalMassMatchesQuadrature) {
  for (const double l : {0.0, 1e-6, 0.1, 1.0, 4.0, 8.0, 32.0, 1e3, 1e6, 1e10})
    EXPECT_LT(worst_error(l, 0, vmf_hemisphere), 0.005) << l;
  EXPECT_NEAR(vmf_hemisphere(0.3, 0), 0.5, 1e-12);
}

TEST(Sg, MeanCosineMatchesQuadrature) {
  for (const double l : {0.0, 1e-6, 0.1, 0.49, 0.51, 1.0, 4.0, 8.0})
    EXPECT_LT(worst_error(l, 1, cosine_mean), 1.5e-3) << l;
  for (const double l : {32.0, 100.0, 1e4, 1e8, 1e12}) EXPECT_LT(worst_error(l, 1, cosine_mean), 2e-4) << l;
  EXPECT_NEAR(cosine_mean(0.7, 0), 0.25, 1e-12);
  EXPECT_NEAR(cosine_mean(0.7, 1e-9), 0.25, 1e-8);
  EXPECT_NEAR(cosine_mean(0.7, 1e12), 0.7, 1e-6);
  EXPECT_NEAR(cosine_integral(1, 0), pi, 1e-12);
}

// Vectors of float32 are unit vectors to 1e-7 only.
TEST(Sg, MeanCosineOfUnitVectorsThatAreTooLong) {
  for (const double l : {0.0, 1e-3, 1.0, 1e4, 1e8, sharpness_max})
    for (const double excess : {1e-15, 1e-7, 1e-3}) {
      EXPECT_NEAR(cosine_mean(1 + excess, l), cosine_mean(1, l), 1e-12) << l << " " << excess;
      EXPECT_NEAR(cosine_mean(-1 - excess, l), cosine_mean(-1, l), 1e-12) << l << " " << excess;
    }
}

}  // namespace
}  // namespace vsgl
