// Radiance of lit spheres: the closed forms and fits against quadratures.

#include "sh/emission.h"

#include <gtest/gtest.h>

#include "sphere_rule.h"

namespace vsgl::sh {
namespace {

using test::pi;

TEST(Emission, ClosedFormIsTheQuadrature) {
  for (const double sine : {0.01, 0.1, 0.3, 0.7, 0.95, 1.0})
    for (int l = 0; l < kEmissionOrder; ++l)
      EXPECT_NEAR(mean_emission_closed(sine)[l], mean_emission(sine)[l], 1e-8) << sine << ", band " << l;
}

// Monte Carlo's plain way round: rays from the origin, their intersection with the sphere.
TEST(Emission, QuadratureIsTheMeanOverRays) {
  const double sine = 0.6, cosine = 0.8;
  EmissionZonal sums{};
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (1 - cosine) * (i + 0.5) / count, r = std::sqrt(1 - z * z);
    const double distance = z - std::sqrt(z * z - cosine * cosine);
    const Vector y = basis({distance * r / sine, 0, (distance * z - 1) / sine});
    for (int l = 0; l < kEmissionOrder; ++l) sums[l] += y[index(l, 0)] / count;
  }
  for (int l = 0; l < kEmissionOrder; ++l) EXPECT_NEAR(mean_emission(sine)[l], sums[l], 1e-5) << l;
}

// A distant sphere in parallel light has 2/3 of its irradiance on the side that is seen; a plane has its own.
TEST(Emission, Limits) {
  const EmissionZonal far = mean_emission(1e-6), near = mean_emission(1);
  EXPECT_NEAR(far[1], -2.0 / 3 * std::sqrt(3 / (4 * pi)), 1e-5);
  EXPECT_NEAR(far[2], std::sqrt(5.0) / (8 * std::sqrt(pi)), 1e-5);
  EXPECT_NEAR(near[1], -std::sqrt(3 / (4 * pi)), 1e-12);
  EXPECT_NEAR(near[2], std::sqrt(5 / (4 * pi)), 1e-12);
}

// [Sloan 2007, Fig. 4] states relative squared errors of 0.00016% and 0.00064%: met to two digits, as the
// coefficients are printed to five.
TEST(Emission, PolynomialsAreWithinThePapersErrors) {
  double error[kEmissionOrder] = {}, square[kEmissionOrder] = {};
  for (int i = 0; i < 1000; ++i) {
    const double sine = (i + 0.5) / 1000;
    const EmissionZonal exact = mean_emission(sine), fit = mean_emission_polynomial(sine);
    for (int l = 0; l < kEmissionOrder; ++l) {
      error[l] += std::pow(fit[l] - exact[l], 2);
      square[l] += std::pow(exact[l], 2);
    }
  }
  EXPECT_LE(error[1] / square[1], 1.9e-6);
  EXPECT_LE(error[2] / square[2], 6.4e-6);
  RecordProperty("linear", std::to_string(error[1] / square[1]));
}

// The constant part of the radiance is the mean times the solid angle.
TEST(Emission, MatrixHoldsTheMean) {
  for (const double sine : {0.02, 0.4, 0.9, 1.0}) {
    const EmissionMatrix matrix = emission_matrix(sine);
    const double solid_angle = 2 * pi * below_of_sine(sine);
    for (int k = 0; k < kEmissionOrder; ++k)
      EXPECT_NEAR(matrix.at(0, k, 0), solid_angle * mean_emission(sine)[k] / std::sqrt(4 * pi), 1e-8);
    EXPECT_EQ(matrix.at(0, 1, 1), 0);
    EXPECT_EQ(matrix.at(2, 1, -1), matrix.at(2, 1, 1));
  }
}

// An even irradiance gives an even disk.
TEST(Emission, MatrixOfAConstantIsTheCap) {
  for (const double sine : {0.1, 0.8}) {
    const EmissionMatrix matrix = emission_matrix(sine);
    for (int j = 0; j < kEmissionOrder; ++j)
      EXPECT_NEAR(matrix.at(j, 0, 0), cap(below_of_sine(sine))[j] / std::sqrt(4 * pi), 1e-10);
  }
}

}  // namespace
}  // namespace vsgl::sh
