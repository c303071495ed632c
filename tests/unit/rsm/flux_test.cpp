// The flux of an RSM is the integral of the light's intensity, whatever it falls on.
#include <gtest/gtest.h>

#include "scenes.h"

namespace vsgl {
namespace {

using std::numbers::pi;
using test::bake;

constexpr double kDegree = pi / 180;

void expect_near(Vec3 actual, Vec3 expected, double relative) {
  EXPECT_NEAR(actual.x, expected.x, relative * expected.x);
  EXPECT_NEAR(actual.y, expected.y, relative * expected.y);
  EXPECT_NEAR(actual.z, expected.z, relative * expected.z);
}

// Integral of the spot's intensity over its cone, W.
Vec3 spot_integral(const LightSource& light) {
  constexpr int kSteps = 100000;
  const double span = 1 - light.cos_outer;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += spot_falloff(light, light.cos_outer + (i + 0.5) / kSteps * span);
  return 2 * pi * span / kSteps * sum * light.intensity;
}

TEST(Flux, HardSpotIsItsSolidAngle) {
  const scene::Scene scene = test::scene_of({test::tilted_plane(0)}, {test::spot(30, 30)});
  expect_near(test::total_flux(bake(scene, 512)), 2 * pi * (1 - std::cos(30 * kDegree)) * Vec3{1, 2, 3},
              1e-4);
}

TEST(Flux, SoftSpotIsTheIntegralOfItsFallOff) {
  const LightSource light = test::spot(20, 40);
  const scene::Scene scene = test::scene_of({test::tilted_plane(0)}, {light});
  expect_near(test::total_flux(bake(scene, 512)), spot_integral(light), 1e-4);
  expect_near(test::total_flux(bake(scene, 16)), spot_integral(light), 1e-3);
}

TEST(Flux, TiltDoesNotMatter) {
  const LightSource light = test::spot(30, 40);
  const Vec3 flat = test::total_flux(bake(test::scene_of({test::tilted_plane(0)}, {light}), 256));
  const Vec3 tilted = test::total_flux(bake(test::scene_of({test::tilted_plane(45)}, {light}), 256));
  expect_near(tilted, flat, 1e-6);
}

TEST(Flux, NonSquareSizesHoldTheSame) {
  const LightSource light = test::spot(20, 40);
  const Rsm rsm = bake(test::scene_of({test::tilted_plane(0)}, {light}), 200, 96);
  EXPECT_EQ(rsm.size, 256);
  EXPECT_EQ(rsm.width, 200);
  EXPECT_EQ(rsm.height, 96);
  expect_near(test::total_flux(rsm), spot_integral(light), 1e-3);
  for (int y = 0; y < 256; ++y) {
    for (int x = y < 96 ? 200 : 0; x < 256; ++x) {
      const std::size_t i = static_cast<std::size_t>(256 * y + x);
      ASSERT_EQ(rsm.layers[0].surface[i].id, interop::NO_INSTANCE) << x << "," << y;
      ASSERT_EQ(rsm.layers[0].pyramid[i].flux.x, 0);
    }
  }
}

TEST(Flux, DirectionalIsIrradianceTimesArea) {
  LightSource sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  sun.intensity = {1, 2, 3};
  for (const double tilt : {0.0, 60.0}) {  // a plane that fills the view of the bounding sphere of radius 10
    const Rsm rsm = bake(test::scene_of({test::tilted_plane(tilt)}, {sun}), 128);
    const double width = 2 * rsm.layers[0].light.extent_x;
    EXPECT_NEAR(width, 20, 0.1);
    if (tilt == 0) expect_near(test::total_flux(rsm), width * width * Vec3{1, 2, 3}, 1e-5);
  }
  // A square of 4 m^2 within the view, texels of 0.04 m.
  const Rsm rsm = bake(test::scene_of({test::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, {sun}), 500, 500);
  expect_near(test::total_flux(rsm), 4 * Vec3{1, 2, 3}, 0.03);
}

TEST(Flux, PointInAClosedRoomIsTheWholeSphere) {
  LightSource lamp;
  lamp.name = "lamp";
  lamp.type = LightType::point;
  lamp.position = {0.3, -0.2, 0.4};
  lamp.intensity = {1, 2, 3};
  const Rsm rsm = bake(test::scene_of(test::room(1), {lamp}), 64);
  ASSERT_EQ(rsm.layers.size(), 6u);
  EXPECT_EQ(rsm.layers[0].name, "lamp.px");
  EXPECT_EQ(rsm.layers[5].name, "lamp.nz");
  expect_near(test::total_flux(rsm), 4 * pi * Vec3{1, 2, 3}, 1e-4);
  expect_near(test::total_flux(bake(test::scene_of(test::room(1), {lamp}), 1)), 4 * pi * Vec3{1, 2, 3}, 1e-4);
}

// Every direction is seen by exactly one face, and each face sees the wall that its name says.
TEST(Flux, CubeFacesLookTheRightWay) {
  LightSource lamp;
  lamp.name = "lamp";
  lamp.type = LightType::point;
  const Rsm rsm = bake(test::scene_of(test::room(1), {lamp}), 32);
  const Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::size_t face = 0; face < 6; ++face) {
    for (const interop::Surface& s : rsm.layers[face].surface) {
      ASSERT_NEAR(dot(to_double(s.position), axes[face]), 1, 1e-6) << rsm.layers[face].name;
      ASSERT_NEAR(dot(to_double(s.normal), axes[face]), -1, 1e-6);
    }
    // The top row is on the side of `up`, the left column away from `right`.
    const LightSource& view = rsm.layers[face].light;
    const Vec3 corner = to_double(rsm.layers[face].surface.front().position);
    EXPECT_GT(dot(corner, view.up), 0.9);
    EXPECT_LT(dot(corner, view.right), -0.9);
    EXPECT_EQ(cross(view.right, view.up), -view.forward);
  }
}

}  // namespace
}  // namespace vsgl
