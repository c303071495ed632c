// Soft global illumination: closed forms, limits and bounds.

#include "stages/soft_gi/soft_gi.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "../expect_error.h"
#include "scene/transform.h"
#include "sh/basis.h"
#include "soft_gi_scene.h"

namespace vsgl {
namespace {

using namespace test;

constexpr Vec3 kUp{0, 1, 0};

// Seen from the origin at that half angle, in that direction.
ProxySphere sphere_at(Vec3 direction, double degrees, Vec3 albedo = {1, 1, 1}, double distance = 2) {
  return {distance * normalise(direction), distance * std::sin(degrees * pi / 180), albedo};
}

std::vector<ProxySphere> random_spheres(int count, double largest, std::uint32_t seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<ProxySphere> out;
  for (int i = 0; i < count; ++i)
    out.push_back({{4 * uniform(random) - 2, 3 * uniform(random) - 0.5, 4 * uniform(random) - 2},
                   largest * (0.1 + 0.9 * uniform(random)),
                   {uniform(random), uniform(random), uniform(random)}});
  return out;
}

std::vector<Point> floor_points(int side) {
  std::vector<Point> out;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      out.push_back({{4.0 * column / side - 2, 0, 4.0 * row / side - 2}, kUp});
  return out;
}

TEST(SoftGi, WithoutProxiesAllLightArrives) {
  const std::vector<Point> points{{{}, kUp}, {{1, 2, 3}, {0.3, -1, 0.2}}, {{}, {-1, 0, 0}}};
  const auto sky = coloured_sky();
  const auto light = soft_gi::project(sky);
  Occlusion occlusion;
  const Indirect image = shade(gbuffer_of(points), {}, sky, everywhere(), &occlusion);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 expected = soft_gi::irradiance(light, normalise(points[i].normal)) / pi;
    EXPECT_LE(length(widen(image.direct[i]) - expected), 1e-5) << i;
    EXPECT_EQ(widen(image.diffuse[i]), Vec3{}) << i;
    EXPECT_NEAR(occlusion.vectors[i][0], std::sqrt(4 * pi), 1e-6);
    EXPECT_EQ(occlusion.vectors[i][1], 0);
  }
}

// An even sky's irradiance behind a cap is pi (1 - sin^2 theta cos tilt), as long as the cap is above the
// horizon.
TEST(SoftGi, OneSphereHidesItsFormFactor) {
  const GBuffer gbuffer = gbuffer_of({{{}, kUp}});
  for (const double tilt : {0.0, 30.0, 60.0})
    for (const double degrees : {5.0, 15.0, 25.0, 40.0}) {
      if (tilt + degrees > 90) continue;
      const Vec3 direction{std::sin(tilt * pi / 180), std::cos(tilt * pi / 180), 0};
      const Indirect image =
          shade(gbuffer, proxies_of({sphere_at(direction, degrees)}), even_sky(), everywhere());
      const double sine = std::sin(degrees * pi / 180);
      EXPECT_NEAR(image.direct[0].x, 1 - sine * sine * direction.y, 0.02) << tilt << ", " << degrees;
      // It sends back what it hides, but for the light that it gets from below.
      EXPECT_NEAR(image.diffuse[0].x, sine * sine * direction.y, 0.03) << tilt << ", " << degrees;
    }
}

// At low order small spheres do not see that they overlap.
TEST(SoftGi, CoincidentSpheresShareTheirLight) {
  const GBuffer gbuffer = gbuffer_of({{{}, kUp}});
  struct Row {
    double degrees, two, eight;
  };
  for (const Row& row :
       {Row{10, 0.94, 0.65}, Row{20, 0.81, 0.17}, Row{30, 0.67, 0.07}, Row{45, 0.58, 0.19}}) {
    const auto indirect = [&](std::size_t count) {
      const std::vector<ProxySphere> same(count, sphere_at(kUp, row.degrees));
      return shade(gbuffer, proxies_of(same), even_sky(), everywhere()).diffuse[0].x;
    };
    EXPECT_NEAR(indirect(2) / (2 * indirect(1)), row.two, 0.01) << row.degrees;
    EXPECT_NEAR(indirect(8) / (8 * indirect(1)), row.eight, 0.02) << row.degrees;
  }
}

// White spheres under an even sky of radiance 1. The share of the sphere of directions that they cover
// together, and so the mean of their radiance over it, is at most 1; the mean over all normals of what
// receivers get is a little more, as each leaves out what is below it.
TEST(SoftGi, OverlapsNeverGiveMoreThanTheSkyHolds) {
  std::vector<Point> points;
  for (int i = 0; i < 64; ++i) {
    const double z = 1 - (2 * i + 1) / 64.0, r = std::sqrt(1 - z * z);
    points.push_back({{0, 0.2, 0}, {r * std::cos(2.4 * i), r * std::sin(2.4 * i), z}});
  }
  for (const int count : {1, 20, 1000})
    for (const auto& emission : emissions()) {
      auto spheres = random_spheres(count, 0.6);
      for (ProxySphere& sphere : spheres) sphere.albedo = {1, 1, 1};
      SoftGiParams params = everywhere();
      params.emission = emission.name;
      Occlusion occlusion;
      const Indirect image = shade(gbuffer_of(points), proxies_of(spheres), even_sky(), params, &occlusion);
      double indirect = 0, all = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_TRUE(std::isfinite(image.diffuse[i].x) && std::isfinite(image.direct[i].x));
        EXPECT_GE(occlusion.vectors[i][0], -0.01 * std::sqrt(4 * pi)) << count << " spheres, normal " << i;
        indirect += static_cast<double>(image.diffuse[i].x) / 64;
        all += static_cast<double>(image.diffuse[i].x + image.direct[i].x) / 64;
      }
      EXPECT_LE(indirect, 1.2) << count << " spheres, " << emission.name;
      EXPECT_LE(all, 1.2) << count << " spheres, " << emission.name;
    }
}

TEST(SoftGi, BlackProxiesSendNothing) {
  auto spheres = random_spheres(10, 0.4);
  for (ProxySphere& sphere : spheres) sphere.albedo = {};
  const Indirect image =
      shade(gbuffer_of(floor_points(8), 8), proxies_of(spheres), coloured_sky(), everywhere());
  for (const auto& light : image.diffuse) EXPECT_EQ(widen(light), Vec3{});
}

TEST(SoftGi, TurnsWithTheWorld) {
  const Mat4 turn = scene::rotation_xyz_deg({30, -70, 110});
  std::vector<Point> points = floor_points(4);
  std::vector<ProxySphere> spheres = random_spheres(12, 0.5);
  scene::Environment sky = coloured_sky();
  const Indirect before = shade(gbuffer_of(points), proxies_of(spheres), sky, everywhere());
  for (Point& point : points) point = {turn.direction(point.position), turn.direction(point.normal)};
  for (ProxySphere& sphere : spheres) sphere.center = turn.direction(sphere.center);
  sky.rotation = turn;
  const Indirect after = shade(gbuffer_of(points), proxies_of(spheres), sky, everywhere());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(length(widen(before.direct[i]) - widen(after.direct[i])), 1e-4) << i;
    EXPECT_LE(length(widen(before.diffuse[i]) - widen(after.diffuse[i])), 1e-4) << i;
  }
}

// The rules for self-shadowing: on the sphere itself, within it, and on a plane that cuts it.
TEST(SoftGi, ASphereHardlyShadowsItself) {
  std::vector<Point> points;
  for (int i = 0; i < 100; ++i) {
    const double z = 1 - (2 * i + 1) / 100.0, r = std::sqrt(1 - z * z);
    const Vec3 n{r * std::cos(2.4 * i), r * std::sin(2.4 * i), z};
    points.push_back({n, n});
  }
  for (const double radius : {0.98, 1.0, 1.03}) {
    const Indirect image =
        shade(gbuffer_of(points), proxies_of({{{}, radius, {1, 1, 1}}}), even_sky(), everywhere());
    for (const auto& light : image.direct) EXPECT_NEAR(light.x, 1, 0.05) << radius;
  }
}

TEST(SoftGi, ReceiversWithinAProxyStayFinite) {
  const GBuffer gbuffer =
      gbuffer_of({{{}, kUp}, {{0, 0.3, 0}, kUp}, {{0.2, -0.1, 0}, {1, 0, 0}}, {{0, -0.5, 0}, kUp}});
  for (const auto& emission : emissions())
    for (const auto& exponential : exponentials()) {
      SoftGiParams params = everywhere();
      params.emission = emission.name;
      params.exponential = exponential.name;
      const Indirect image = shade(gbuffer, proxies_of({{{}, 0.5, {1, 1, 1}}}), even_sky(), params);
      for (std::size_t i = 0; i < image.direct.size(); ++i) {
        EXPECT_TRUE(image.direct[i].x >= 0 && image.direct[i].x <= 1.1f) << i;
        EXPECT_TRUE(image.diffuse[i].x >= 0 && image.diffuse[i].x <= 1.1f) << i;
      }
    }
}

// Receivers further apart give about the same where nothing is in between, and pixels that no receiver suits
// what they have alone.
TEST(SoftGi, FewerReceiversDoOnSmoothGround) {
  std::vector<Point> points = floor_points(32);
  for (int i = 0; i < 32; ++i)
    points[static_cast<std::size_t>(32 * i + 17)] = {{0, 1.0 + 0.05 * i, 0}, {1, 0, 0}};
  const GBuffer gbuffer = gbuffer_of(points, 32);
  const Proxies proxies = proxies_of({{{1.4, 1.2, 0}, 0.5, {1, 0.5, 0.2}}});
  SoftGiParams params = everywhere();
  const Indirect full = shade(gbuffer, proxies, coloured_sky(), params);
  for (const int rate : {2, 4, 8}) {
    params.rate = rate;
    const Indirect image = shade(gbuffer, proxies, coloured_sky(), params);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LE(length(widen(image.direct[i]) - widen(full.direct[i])), 0.02 * rate) << rate << ", " << i;
  }
  params.upsample = "bilinear";
  const Indirect image = shade(gbuffer, proxies, coloured_sky(), params);
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    worst = std::max(worst, length(widen(image.direct[i]) - widen(full.direct[i])));
  EXPECT_GT(worst, 0.2);
}

TEST(SoftGi, AnyNumberOfThreadsGivesTheSameBytes) {
  const GBuffer gbuffer = gbuffer_of(floor_points(24), 24);
  const Proxies proxies = proxies_of(random_spheres(30, 0.4));
  const auto run = [&](int threads) {
    gpu::Device own({.threads = threads, .compute_only = true});
    Report report;
    return shade_soft_gi(gbuffer, proxies, coloured_sky(), {.rate = 2}, own, report);
  };
  const Indirect one = run(1), two = run(2);
  for (const auto member : {&Indirect::direct, &Indirect::diffuse})
    EXPECT_EQ(
        std::memcmp((one.*member).data(), (two.*member).data(), (one.*member).size() * sizeof(interop::vec3)),
        0);
}

// Under an even sky a proxy straight ahead hides sin^2 of the light.
TEST(SoftGi, SpheresOfInfluenceSuitTheSky) {
  const auto even = soft_gi::choose_influence(soft_gi::project(even_sky()), 1.0 / 256);
  EXPECT_NEAR(even.shadow, 16, 0.5);
  EXPECT_NEAR(even.indirect, 16, 0.5);
  const auto spot = soft_gi::choose_influence(soft_gi::project(sky_of([](Vec3 d) {
                                                return d.y > 0.95 ? Vec3{1, 1, 1} : Vec3{};
                                              })),
                                              1.0 / 256);
  EXPECT_GT(spot.shadow, 1.3 * even.shadow);
  EXPECT_LT(soft_gi::choose_influence(soft_gi::project(even_sky()), 0.1).shadow, 0.3 * even.shadow);
}

TEST(SoftGi, BeyondItsInfluenceAProxyDoesNothing) {
  const GBuffer gbuffer = gbuffer_of({{{}, kUp}});
  SoftGiParams params = everywhere();
  params.shadow_influence = 8;
  const float all = shade(gbuffer, {}, even_sky(), params).direct[0].x;
  const auto direct = [&](double distance) {
    return shade(gbuffer, proxies_of({{{0, distance, 0}, 1, {1, 1, 1}}}), even_sky(), params).direct[0].x /
           all;
  };
  EXPECT_NEAR(direct(8.01), 1, 1e-6);
  EXPECT_NEAR(direct(6), 1 - 1.0 / 36, 2e-3);
  EXPECT_GT(direct(7.5), direct(7));
  EXPECT_NEAR(direct(7.99), 1, 1e-5);
}

TEST(SoftGi, BadParametersAreErrors) {
  const GBuffer gbuffer = gbuffer_of({{{}, kUp}});
  const auto run = [&](SoftGiParams params, Vec3 anchor = {}) {
    Proxies proxies;
    proxies.anchor = anchor;
    shade(gbuffer, proxies, even_sky(), params);
  };
  expect_error(ErrorCode::out_of_range, {"rate: 3"}, [&] { run({.rate = 3}); });
  expect_error(ErrorCode::out_of_range, {"tolerance"}, [&] { run({.tolerance = 0}); });
  expect_error(ErrorCode::out_of_range, {"influence: 0.5"}, [&] { run({.shadow_influence = 0.5}); });
  expect_error(ErrorCode::bad_value, {"emission: \"guess\"", "averaged"},
               [&] { run({.emission = "guess"}); });
  expect_error(ErrorCode::bad_value, {"upsample: \"guess\"", "plane"}, [&] { run({.upsample = "guess"}); });
  expect_error(ErrorCode::bad_value, {"exponential: \"guess\"", "hyb"},
               [&] { run({.exponential = "guess"}); });
  expect_error(ErrorCode::invalid_data, {"proxies: anchor"}, [&] { run({}, {1, 0, 0}); });
}

}  // namespace
}  // namespace vsgl
