#include <gtest/gtest.h>

#include "math/frame.h"
#include "math/light_source.h"
#include "math/octahedral.h"
#include "math/solid_angle.h"
#include "quadrature.h"

namespace vsgl {
namespace {

using test::pi;

const std::vector<Vec3> directions{{0, 0, 1},     {0, 0, -1},         {1, 0, 0},           {0, -1, 0},
                                   {0.6, 0, 0.8}, {0.48, -0.6, 0.64}, {-0.48, 0.6, -0.64}, {1e-8, 1e-8, -1}};

TEST(Frame, IsOrthonormalAndRightHanded) {
  for (const Vec3 n : directions) {
    const Frame f = frame_about(n);
    EXPECT_NEAR(length(f.x), 1, 1e-7);
    EXPECT_NEAR(dot(f.x, f.y), 0, 1e-7);
    EXPECT_NEAR(dot(f.x, n), 0, 1e-7);
    EXPECT_NEAR(length(cross(f.x, f.y) - n), 0, 1e-7);
    EXPECT_NEAR(length(f.to_world(f.to_local({1, 2, 3})) - Vec3{1, 2, 3}), 0, 1e-6);
  }
}

TEST(Octahedral, MapIsABijectionWhoseTexelsCoverTheHemisphere) {
  for (const Vec3 v : directions) {
    if (v.z < 0) continue;
    const Vec2 e = hemi_octahedral_encode(2.5 * v);
    EXPECT_LE(std::max(std::abs(e.x), std::abs(e.y)), 1 + 1e-12);
    EXPECT_NEAR(length(hemi_octahedral_decode(e) - v), 0, 1e-12);
  }
  constexpr int size = 64;
  double sum = 0;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i)
      sum += hemi_octahedral_solid_angle({2 * (i + 0.5) / size - 1, 2 * (j + 0.5) / size - 1}, size);
  EXPECT_NEAR(sum / (2 * pi), 1, 1e-4);
}

TEST(SolidAngle, RectanglesAddUpToTheFrustum) {
  EXPECT_NEAR(rectangle_solid_angle(-1, -1, 1, 1), 4 * pi / 6, 1e-14);  // a cube's face
  EXPECT_NEAR(rectangle_solid_angle(-0.5, -0.5, 0.5, 0.5), 4 * std::asin(0.25 / 1.25), 1e-14);
  double exact = 0, midpoint = 0;
  constexpr int size = 64;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const double x = 2.0 * i / size - 1, y = 2.0 * j / size - 1, h = 2.0 / size;
      exact += rectangle_solid_angle(x, y, x + h, y + h);
      midpoint += midpoint_solid_angle(x + h / 2, y + h / 2, h * h);
    }
  EXPECT_NEAR(exact, 4 * pi / 6, 1e-12);
  EXPECT_NEAR(midpoint / exact, 1, 1e-4);
}

TEST(LightSource, SpotFallsOffBetweenItsCones) {
  LightSource light;
  light.intensity = {2, 4, 6};
  light.cos_inner = 0.9, light.cos_outer = 0.8;
  EXPECT_EQ(spot_falloff(light, 0.95), 1);
  EXPECT_EQ(spot_falloff(light, 0.7), 0);
  EXPECT_NEAR(spot_falloff(light, 0.85), 0.25, 1e-12);
  EXPECT_NEAR(intensity_towards(light, {std::sqrt(1 - 0.85 * 0.85), 0, -0.85}).y, 1, 1e-12);
  light.cos_inner = light.cos_outer = 0.8;  // hard edge
  EXPECT_EQ(spot_falloff(light, 0.8), 1);
  EXPECT_EQ(spot_falloff(light, 0.7999), 0);
  light.type = LightType::point;
  EXPECT_EQ(intensity_towards(light, {0, 0, 1}), light.intensity);
}

}  // namespace
}  // namespace vsgl
