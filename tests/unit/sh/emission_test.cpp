// Radiance of lit spheres: closed forms against quadratures, and the polynomials that were fitted to them.

#include "sh/emission.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "sphere_rule.h"

namespace vsgl::sh {
namespace {

using test::pi;

// As the paper prints it, which cancels where the sine is small.
TEST(Emission, MeanIsThePapersClosedForm) {
  for (const double sine : {0.01, 0.1, 0.3, 0.7, 0.95, 1.0}) {
    const double d = 1 / sine, e = std::sqrt(d * d - 1), d2 = d * d, d3 = d2 * d;
    const EmissionZonal printed{
        1 / (2 * std::sqrt(pi)),
        -std::sqrt(3.0) * (2 * d3 - 2 * e * d2 - e + 1) / (6 * std::sqrt(pi) * d * (d - e)),
        std::sqrt(5.0) * (6 * d2 * d3 - 6 * e * d2 * d2 - 3 * e * d2 - e + 4) /
            (20 * std::sqrt(pi) * d2 * (d - e))};
    for (int l = 0; l < kEmissionOrder; ++l)
      EXPECT_NEAR(mean_emission(sine)[l], printed[l], 1e-8) << sine << ", band " << l;
  }
}

// Monte Carlo's plain way round: rays from the origin, their intersection with the sphere.
TEST(Emission, MeanIsThatOverRays) {
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

double evaluate(const std::vector<double>& polynomial, double x) {  // the highest power first
  double sum = 0;
  for (const double coefficient : polynomial) sum = sum * x + coefficient;
  return sum;
}

// Over the midpoints of `count` steps of the sine.
double relative_squared_error(const std::vector<double>& polynomial, int band, int count) {
  double error = 0, square = 0;
  for (int i = 0; i < count; ++i) {
    const double sine = (i + 0.5) / count, exact = mean_emission(sine)[band];
    error += std::pow(evaluate(polynomial, sine) - exact, 2);
    square += std::pow(exact, 2);
  }
  return error / square;
}

// [Sloan 2007, Fig. 4] states relative squared errors of 1.6e-6 for the linear part and 6.4e-6 for the
// quadratic one. The printed coefficients are the least-squares fit over 64 midpoints, to their last digit:
// no other quadratic polynomial has less than 1.76e-6 there.
TEST(Emission, PrintedPolynomialsAreTheBestOfTheirDegree) {
  const std::vector<double> linear{0.08432, -0.25073, -0.32494},
      quadratic{-0.22230, 0.22502, 0.47398, 0.15950};
  EXPECT_NEAR(relative_squared_error(linear, 1, 64), 1.763e-6, 1e-9);
  EXPECT_NEAR(relative_squared_error(linear, 1, 10000), 1.785e-6, 1e-9);
  EXPECT_LE(relative_squared_error(quadratic, 2, 10000), 6.4e-6);
  for (const auto& [polynomial, band] : {std::pair{linear, 1}, std::pair{quadratic, 2}})
    for (std::size_t power = 0; power < polynomial.size(); ++power) {
      double along = 0, norm = 0;  // of the error along a power of the sine
      for (int i = 0; i < 64; ++i) {
        const double sine = (i + 0.5) / 64, x = std::pow(sine, power);
        along += x * (evaluate(polynomial, sine) - mean_emission(sine)[band]);
        norm += x * x;
      }
      // What a change of the printed digits' last place may leave.
      EXPECT_LE(std::abs(along) / norm, 2e-5) << "band " << band << ", power " << power;
    }
}

// The constant part of the radiance is the mean times the solid angle.
TEST(Emission, MatrixHoldsTheMean) {
  for (const double sine : {0.02, 0.4, 0.9, 1.0}) {
    const EmissionMatrix matrix = emission_matrix(sine);
    const double solid_angle = 2 * pi * below_of_sine(sine);
    for (int k = 0; k < kEmissionOrder; ++k)
      EXPECT_NEAR(matrix.at(0, k, 0), solid_angle * mean_emission(sine)[k] / std::sqrt(4 * pi), 1e-12);
    EXPECT_EQ(matrix.at(0, 1, 1), 0);
    EXPECT_EQ(matrix.at(2, 1, -1), matrix.at(2, 1, 1));
  }
}

// All couplings, from directions within the cone all about its axis, and the sphere's normals where they meet
// it.
TEST(Emission, MatrixIsThatOverRays) {
  const double sine = 0.6, cosine = 0.8;
  double sums[9][9] = {};
  const int count = 4000, azimuths = 12;
  for (int i = 0; i < count; ++i)
    for (int a = 0; a < azimuths; ++a) {
      const double z = 1 - (1 - cosine) * (i + 0.5) / count, r = std::sqrt(1 - z * z),
                   azimuth = 2 * pi * a / azimuths;
      const Vec3 direction{r * std::cos(azimuth), r * std::sin(azimuth), z};
      const Vec3 hit = (z - std::sqrt(z * z - cosine * cosine)) * direction;
      const Vector to = basis(direction), from = basis((hit - Vec3{0, 0, 1}) / sine);
      for (int j = 0; j < 9; ++j)
        for (int k = 0; k < 9; ++k) sums[j][k] += 2 * pi * (1 - cosine) / count / azimuths * to[j] * from[k];
    }
  const EmissionMatrix matrix = emission_matrix(sine);
  for (int j = 0; j < kEmissionOrder; ++j)
    for (int k = 0; k < kEmissionOrder; ++k)
      for (int m = -j; m <= j; ++m)
        for (int n = -k; n <= k; ++n)
          EXPECT_NEAR(sums[index(j, m)][index(k, n)], m == n ? matrix.at(j, k, m) : 0, 1e-6)
              << j << ", " << m << "; " << k << ", " << n;
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
