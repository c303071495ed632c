// Logarithms and exponentials of occlusion.

#include "sh/exponential.h"

#include <gtest/gtest.h>

#include <random>

#include "sphere_rule.h"

namespace vsgl::sh {
namespace {

using test::pi;

double below_of_degrees(double degrees) {
  return 2 * std::pow(std::sin(degrees * pi / 360), 2);
}
Vector minus(const Vector& a, const Vector& b) {
  Vector out = a;
  for (int i = 0; i < kCoefficients; ++i) out[i] -= b[i];
  return out;
}
double norm(const Vector& f) {
  return std::sqrt(dot(f, f));
}
Vector occlusion(double below, Vec3 axis) {
  return minus(one(), turn(cap(below), axis));
}
double relative_error(const Vector& found, const Vector& expected) {
  return norm(minus(found, expected)) / norm(expected);
}

TEST(Logarithm, OfACap) {
  struct Row {
    double degrees;
    Zonal f;
  };
  // Of an implementation in another language.
  for (const Row& row :
       {Row{10, {-.0286, -.0484, -.0612, -.0700}}, Row{30, {-.3642, -.5647, -.6190, -.5615}},
        Row{45, {-1.3141, -1.9510, -1.8890, -1.3801}}, Row{60, {-2.7007, -3.8489, -3.2336, -1.8459}},
        Row{90, {-6.2064, -6.1242, -1.4871, 1.4614}}})
    for (int l = 0; l < kOrder; ++l)
      EXPECT_NEAR(log_occlusion(below_of_degrees(row.degrees))[l], row.f[l], 6e-5)
          << row.degrees << ", " << l;
}

TEST(Logarithm, IsTheInverseOfTheExponential) {
  const Vec3 axis = normalise({1, -1, 0.4});
  for (const double degrees : {0.5, 3.82, 10.0, 25.0, 40.0}) {
    const double below = below_of_degrees(degrees);
    const Vector f = turn(log_occlusion(below), axis), g = occlusion(below, axis);
    EXPECT_LE(relative_error(exp_exact(f), g), 2e-4) << degrees;
    EXPECT_LE(relative_error(exp_second_order(f), g), 6e-3) << degrees;
    EXPECT_LE(relative_error(exp_hyb(f), g), 7e-3) << degrees;
  }
}

TEST(Exponential, OfAConstantIsExact) {
  Vector f = one(), expected = one();
  for (double& value : f) value *= -2.5;
  expected[0] *= std::exp(-2.5);
  for (const auto& exponential : {exp_exact, exp_second_order, exp_hyb})
    EXPECT_LE(norm(minus(exponential(f), expected)), 1e-12);
}

// Twice the vector, eight times the error: 1 + x + x*x/2 is exact to the second order.
TEST(Exponential, SecondOrderErrsInTheThird) {
  const Vector f = turn(log_occlusion(below_of_degrees(12)), normalise({1, 2, -1}));
  const auto error = [&](double factor) {
    Vector x = f;
    for (double& value : x) value *= factor / norm(f);
    x[0] = 0;
    return norm(minus(exp_second_order(x), exp_exact(x)));
  };
  EXPECT_NEAR(error(0.02) / error(0.01), 8, 0.1);
  EXPECT_NEAR(error(0.2) / error(0.1), 8, 0.5);
}

TEST(Exponential, Squarings) {
  EXPECT_EQ(squarings(0, 1), 0);
  EXPECT_EQ(squarings(1, 1), 0);
  EXPECT_EQ(squarings(1.01, 1), 1);
  EXPECT_EQ(squarings(5, 0.25), 5);
  EXPECT_EQ(squarings(1e30, 1), kMaxSquarings);
}

struct Errors {
  double exact, second_order, hyb;  // relative to the products of the occlusions, mean
};
// `count` caps of random axes, half angles 0..widest.
Errors measure(int count, double widest, int trials) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  Errors errors{};
  for (int trial = 0; trial < trials; ++trial) {
    Vector sum{}, exact = one();
    for (int i = 0; i < count; ++i) {
      const double z = 2 * uniform(random) - 1, azimuth = 2 * pi * uniform(random);
      const Vec3 axis{std::sqrt(1 - z * z) * std::cos(azimuth), std::sqrt(1 - z * z) * std::sin(azimuth), z};
      const double below = below_of_degrees(widest * uniform(random));
      const Vector f = turn(log_occlusion(below), axis);
      for (int k = 0; k < kCoefficients; ++k) sum[k] += f[k];
      exact = product(exact, occlusion(below, axis));
    }
    errors.exact += relative_error(exp_exact(sum), exact) / trials;
    errors.second_order += relative_error(exp_second_order(sum), exact) / trials;
    errors.hyb += relative_error(exp_hyb(sum), exact) / trials;
  }
  return errors;
}

// Caps of half angles up to 45 degrees, and of up to 20 degrees where there are 64.
TEST(Exponential, AgainstTheProductOfManyCaps) {
  const Errors four = measure(4, 45, 40), eight = measure(8, 45, 40), many = measure(64, 20, 40);
  EXPECT_LE(four.hyb, 0.036);
  EXPECT_LE(eight.hyb, 0.057);
  EXPECT_LE(many.hyb, 0.03);
  for (const Errors& errors : {four, eight, many}) {
    EXPECT_LE(errors.second_order, errors.hyb + 1e-4);
    EXPECT_LE(errors.exact, errors.second_order);
  }
}

}  // namespace
}  // namespace vsgl::sh
