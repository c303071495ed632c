#include "math/vsgl.h"

#include <gtest/gtest.h>

#include "quadrature.h"

namespace vsgl {
namespace {

using test::pi;

// Integral over the sphere of SG(-axis, sharpness) SG(u, d^2 / variance) / (2 pi variance), by a product rule
// about the narrower one.
double fluence_by_quadrature(Vec3 v, double variance, Vec3 axis, double sharpness) {
  SgLobe narrow{normalise(v), dot(v, v) / variance}, wide{-axis, sharpness};
  if (wide.sharpness > narrow.sharpness) std::swap(narrow, wide);
  const Frame frame = frame_about(narrow.axis);
  constexpr int rows = 600, columns = 200;
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    const double z = test::vmf_quantile((i + 0.5) / rows, narrow.sharpness),
                 r = std::sqrt(std::max(1 - z * z, 0.0));
    for (int j = 0; j < columns; ++j) {
      const double angle = 2 * pi * (j + 0.5) / columns;
      sum +=
          sg_value(frame.to_world({r * std::cos(angle), r * std::sin(angle), z}), wide.axis, wide.sharpness);
    }
  }
  return sum / (rows * columns) * sg_integral(narrow.sharpness) / (2 * pi * variance);
}

TEST(Vsgl, FluenceIsTheIntegralOfTheModelsRadiance) {
  const Vec3 v{0.3, -1, 2};
  for (const double variance : {0.01, 0.5, 40.0})
    for (const double sharpness : {0.0, 2.2925, 30.0})
      for (const Vec3 axis : {-normalise(v), normalise(Vec3{1, 0.2, -0.4})}) {
        const VsglIncoming in = vsgl_incoming(v, variance, axis, sharpness);
        EXPECT_NEAR(in.fluence / fluence_by_quadrature(v, variance, axis, sharpness), 1, 5e-3)
            << variance << " " << sharpness;
      }
}

TEST(Vsgl, FacingReceiverHasAClosedForm) {
  for (const double variance : {1e-6, 0.1, 10.0})
    for (const double sharpness : {0.0, 2.2925, 100.0, 1e4})
      for (const double d : {1e-3, 1.0, 1e3}) {
        const double expected =
            -std::expm1(-2 * (d * d / variance + sharpness)) / (d * d + variance * sharpness);
        EXPECT_NEAR(vsgl_incoming({0, 0, d}, variance, {0, 0, -1}, sharpness).fluence / expected, 1, 1e-9);
      }
}

TEST(Vsgl, PointLightFollowsTheInverseSquare) {
  const Vec3 axis = normalise(Vec3{0.1, 0.3, -1}), v{0.5, 0.2, 3};
  for (const double sharpness : {0.0, 5.0, 300.0}) {
    const VsglIncoming in = vsgl_incoming(v, 0, axis, sharpness);
    EXPECT_NEAR(in.fluence * dot(v, v) / sg_value(-normalise(v), axis, sharpness), 1, 1e-12);
    EXPECT_EQ(in.sharpness, sharpness_max);
    EXPECT_NEAR(vsgl_incoming_disk(v, 0, axis, sharpness).fluence / in.fluence, 1, 1e-12);
  }
}

TEST(Vsgl, ReceiverInsideTheLightIsFinite) {
  const Vec3 axis{0, 0, -1};
  for (const double sharpness : {0.0, 2.2925, 1e4}) {
    const VsglIncoming in = vsgl_incoming({0, 0, 0}, 0.3, axis, sharpness);
    EXPECT_NEAR(in.fluence, sg_integral(sharpness) / (2 * pi * 0.3), 1e-12 * in.fluence);
    EXPECT_NEAR(in.sharpness, sharpness, 1e-9 * (1 + sharpness));
    EXPECT_EQ(in.axis, -axis);
  }
  EXPECT_NEAR(vsgl_incoming({0, 0, 0}, 0.3, axis, 0).fluence, 2 / 0.3, 1e-12);
  EXPECT_TRUE(std::isfinite(vsgl_incoming({0, 0, 0}, 0, axis, 10).fluence));
}

TEST(Vsgl, DiskConeMatchesItsSolidAngle) {
  for (const double ratio : {1e-4, 0.01, 0.3, 1.0}) {  // r / d
    const DiskCone cone = disk_cone(2, 4 * ratio * ratio);
    const double exact = 2 * pi * (1 - 1 / std::sqrt(1 + ratio * ratio));
    EXPECT_NEAR(cone.solid_angle / exact, 1, ratio < 1e-3 ? 1e-7 : 1e-10);
    EXPECT_NEAR(cone.density * pi * 4 * ratio * ratio / cone.solid_angle, 1, 1e-12);
    EXPECT_NEAR(2 * sg_integral(cone.sharpness) / cone.solid_angle, 1, 1e-5);
  }
  EXPECT_NEAR(disk_cone(0, 9).density, 2.0 / 9, 1e-12);
  EXPECT_NEAR(disk_cone(7, 0).density, 1.0 / 49, 1e-12);
}

TEST(Vsgl, DiskFluenceIsTheProductWithItsCone) {
  const Vec3 v{1, 0.5, 0.2}, axis = normalise(Vec3{-1, 0.3, 0.1});
  for (const double variance : {1e-4, 0.2, 5.0})
    for (const double sharpness : {0.0, 8.0}) {
      const DiskCone cone = disk_cone(length(v), 4 * variance);
      const SgProduct product = sg_product(normalise(v), cone.sharpness, -axis, sharpness);
      const double expected =
          2 * std::exp(product.exponent) * sg_integral(product.sharpness) / (4 * pi * variance);
      const VsglIncoming in = vsgl_incoming_disk(v, variance, axis, sharpness);
      EXPECT_NEAR(in.fluence / expected, 1, 1e-9);
      EXPECT_NEAR(in.sharpness / product.sharpness, 1, 1e-9);
      EXPECT_NEAR(dot(in.axis, product.axis), 1, 1e-9);
    }
}

}  // namespace
}  // namespace vsgl
