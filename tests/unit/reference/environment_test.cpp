// Light of an environment past one ball, against closed forms.

#include "reference/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../expect_error.h"
#include "../synthetic_scene.h"

namespace vsgl::reference {
namespace {

using test::expect_error;

constexpr double kRadius = 0.5, kHeight = 1.25;  // sine of the half angle: 0.4
constexpr double kHidden = kRadius * kRadius / (kHeight * kHeight);

// Radiance 1 from everywhere.
scene::Environment even_sky() {
  return {8, 4, std::vector<Vec3>(32, {1, 1, 1}), {}};
}

// A floor, and a ball above its middle, of its own.
scene::Scene ball_over_floor() {
  scene::Scene scene;
  test::add_quad(scene, {-50, -0.001, 50}, {100, 0, 0}, {0, 0, -100});
  scene::Scene ball;
  constexpr int kRings = 64, kSides = 128;
  const auto at = [](int ring, int side) {
    const double polar = std::numbers::pi * ring / kRings, azimuth = 2 * std::numbers::pi * side / kSides;
    return Vec3{kRadius * std::sin(polar) * std::cos(azimuth), kHeight + kRadius * std::cos(polar),
                kRadius * std::sin(polar) * std::sin(azimuth)};
  };
  for (int ring = 0; ring < kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      test::add_triangle(ball, at(ring, side), at(ring + 1, side + 1), at(ring + 1, side));
      test::add_triangle(ball, at(ring, side), at(ring, side + 1), at(ring + 1, side + 1));
    }
  scene.instances.push_back(ball.instances.front());
  scene.instances[0].name = "floor";
  scene.instances[1].name = "ball";
  scene.materials.front().base_color = {0.5, 0.5, 0.5};
  scene.materials.front().specular = {};
  scene.radius = 75;
  return scene;
}

Proxies ball_proxies() {
  Proxies out;
  out.scene_radius = 75;
  out.objects.push_back({"ball", 1, false, {}, {{{0, kHeight, 0}, kRadius, {0.5, 0.5, 0.5}}}});
  out.receivers.push_back({"floor", 0});
  return out;
}

// A white pixel of the floor, below the ball.
GBuffer pixel() {
  GBuffer out;
  out.width = out.height = 1;
  interop::Surface surface{};
  surface.normal = surface.shading_normal = {0, 1, 0};
  surface.diffuse = {1, 1, 1};
  surface.alpha = 1;
  out.pixels = {surface};
  return out;
}

struct Light {
  double direct, indirect;
};
Light trace(const std::string& blockers, const std::string& bounce) {
  Report report;
  const Proxies proxies = ball_proxies();
  const Reference image =
      trace_environment(ball_over_floor(), even_sky(), &proxies, pixel(),
                        {.samples = 65536, .blockers = blockers, .bounce = bounce}, report);
  return {static_cast<double>(image.radiance.direct[0].x), static_cast<double>(image.radiance.diffuse[0].x)};
}

TEST(ReferenceEnvironment, ABallHidesItsFormFactor) {
  for (const std::string blockers : {"scene", "meshes", "spheres"})
    EXPECT_NEAR(trace(blockers, "unshadowed").direct, 1 - kHidden, 2e-3) << blockers;
}

TEST(ReferenceEnvironment, ABallReflectsWhatItHides) {
  for (const std::string blockers : {"scene", "meshes", "spheres"})
    EXPECT_NEAR(trace(blockers, "unshadowed").indirect, 0.5 * kHidden, 1e-3) << blockers;
}

// A single ball has no shadow on itself; the floor takes the light from its lower side.
TEST(ReferenceEnvironment, ShadowsOnTheBallAreTheFloors) {
  EXPECT_NEAR(trace("spheres", "shadowed").indirect, 0.5 * kHidden, 1e-3);
  EXPECT_NEAR(trace("meshes", "shadowed").indirect, 0.5 * kHidden, 2e-3);
  const double over_floor = trace("scene", "shadowed").indirect;
  EXPECT_LT(over_floor, 0.3 * 0.5 * kHidden);
  EXPECT_GT(over_floor, 0);
}

TEST(ReferenceEnvironment, BadParametersAreErrors) {
  Report report;
  const scene::Scene scene = ball_over_floor();
  const auto run = [&](EnvironmentParams params, const Proxies* proxies) {
    trace_environment(scene, even_sky(), proxies, pixel(), params, report);
  };
  Proxies elsewhere = ball_proxies();
  elsewhere.anchor = {1, 0, 0};
  expect_error(ErrorCode::bad_value, {"blockers", "proxies"}, [&] { run({.blockers = "spheres"}, nullptr); });
  expect_error(ErrorCode::bad_value, {"blockers: \"walls\""}, [&] { run({.blockers = "walls"}, nullptr); });
  expect_error(ErrorCode::bad_value, {"bounce: \"high\""}, [&] { run({.bounce = "high"}, nullptr); });
  expect_error(ErrorCode::out_of_range, {"samples: 0"}, [&] { run({.samples = 0}, nullptr); });
  expect_error(ErrorCode::invalid_data, {"another anchor"}, [&] { run({}, &elsewhere); });
}

}  // namespace
}  // namespace vsgl::reference
