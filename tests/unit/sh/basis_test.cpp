// Spherical harmonics against quadratures of their definitions.

#include "sh/basis.h"

#include <gtest/gtest.h>

#include "sh/product.h"
#include "sphere_rule.h"

namespace vsgl::sh {
namespace {

using test::for_each_direction;
using test::pi;

TEST(Basis, IsOrthonormal) {
  std::array<Vector, kCoefficients> gram{};
  for_each_direction([&](Vec3 s, double weight) {
    const Vector y = basis(s);
    for (int i = 0; i < kCoefficients; ++i)
      for (int j = 0; j < kCoefficients; ++j) gram[i][j] += weight * y[i] * y[j];
  });
  for (int i = 0; i < kCoefficients; ++i)
    for (int j = 0; j < kCoefficients; ++j) EXPECT_NEAR(gram[i][j], i == j, 1e-12) << i << " " << j;
}

TEST(Basis, ThereAre77Triples) {
  EXPECT_EQ(triples().size(), 77u);
}

// f g projected, where it is a polynomial of degree 6.
TEST(Basis, ProductIsTheProjectedProduct) {
  const Vector f = basis(normalise({1, 2, -0.5})), g = basis(normalise({-0.3, 0.8, 0.7}));
  Vector expected{};
  for_each_direction([&](Vec3 s, double weight) {
    const Vector y = basis(s);
    for (int i = 0; i < kCoefficients; ++i) expected[i] += weight * dot(f, y) * dot(g, y) * y[i];
  });
  const Vector found = product(f, g);
  for (int i = 0; i < kCoefficients; ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
  const Vector same = product(f, one());
  for (int i = 0; i < kCoefficients; ++i) EXPECT_NEAR(same[i], f[i], 1e-12);
}

// The projection of a function of s . axis, in rings about the axis.
template <class Function>
Vector project_zonal(Vec3 axis, double from, Function f) {
  Vector sums{};
  const Frame frame = frame_about(axis);
  test::for_each_node(from, 1, [&](double z, double weight) {
    for (int a = 0; a < 16; ++a) {
      const double r = std::sqrt(1 - z * z), azimuth = 2 * pi * a / 16;
      const Vector y = basis(frame.to_world({r * std::cos(azimuth), r * std::sin(azimuth), z}));
      for (int i = 0; i < kCoefficients; ++i) sums[i] += weight * 2 * pi / 16 * f(z) * y[i];
    }
  });
  return sums;
}

TEST(Basis, CapsAndTheirRotations) {
  for (const Vec3 axis : {Vec3{0, 0, 1}, normalise({1, -2, 0.3}), Vec3{0, -1, 0}})
    for (const double degrees : {0.01, 3.82, 45.0, 90.0, 150.0, 180.0}) {
      const double cosine = std::cos(degrees * pi / 180), half = std::sin(degrees * pi / 360);
      const Vector found = turn(cap(2 * half * half), axis);
      const Vector expected = project_zonal(axis, cosine, [](double) { return 1.0; });
      for (int i = 0; i < kCoefficients; ++i)
        EXPECT_NEAR(found[i], expected[i], 1e-5) << degrees << " deg, " << i;
      EXPECT_NEAR(found[0] * std::sqrt(4 * pi), 4 * pi * half * half, 1e-12);  // the solid angle
    }
}

TEST(Basis, ClampedCosine) {
  const Vec3 axis = normalise({0.2, 0.5, -0.4});
  const Vector found = turn(clamped_cosine(), axis);
  const Vector expected = project_zonal(axis, 0, [](double z) { return z; });
  for (int i = 0; i < kCoefficients; ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
  // [Sloan 2007, Eq. (7)] f convolved with it, at the axis, is the integral of both.
  const Vector f = basis(normalise({1, 1, 0.3}));
  EXPECT_NEAR(dot(convolve(f, clamped_cosine()), basis(axis)), dot(f, expected), 1e-12);
}

TEST(Basis, SolidAngleOfASine) {
  for (const double sine : {1e-9, 1e-3, 0.5, 1.0})
    EXPECT_NEAR(below_of_sine(sine) / (2 * std::pow(std::sin(std::asin(sine) / 2), 2)), 1, 1e-7);
}

}  // namespace
}  // namespace vsgl::sh
