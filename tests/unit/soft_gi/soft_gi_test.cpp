// Soft global illumination: closed forms, limits and bounds.

#include "stages/soft_gi/soft_gi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "../expect_error.h"
#include "math/frame.h"
#include "scene/transform.h"
#include "sh/basis.h"
#include "soft_gi_scene.h"
#include "stages/soft_gi/directions.h"
#include "stages/soft_gi/exposure.h"

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

// A sky that is one of the basis functions, and light enough besides to be positive.
TEST(SoftGi, ProjectionFindsTheSkysCoefficients) {
  for (int k = 1; k < sh::kCoefficients; ++k) {
    const auto light = soft_gi::project(sky_of(
        [&](Vec3 d) {
          return Vec3{2 + sh::basis(d)[k], 2, 2 - sh::basis(d)[k]};
        },
        128));
    for (int i = 1; i < sh::kCoefficients; ++i) {
      EXPECT_NEAR(light[0][i], i == k, 2e-3) << k << ", " << i;
      EXPECT_NEAR(light[2][i], -(i == k), 2e-3) << k << ", " << i;
    }
    EXPECT_NEAR(light[1][0], 2 * std::sqrt(4 * pi), 1e-9);
    EXPECT_LT(soft_gi::least_radiance(light), 1.98);
    EXPECT_GT(soft_gi::least_radiance(light), 1.7);
  }
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
      // No overlaps: nothing to normalise.
      const Indirect published =
          shade(gbuffer, proxies_of({sphere_at(direction, degrees)}), even_sky(), as_published());
      EXPECT_NEAR(published.diffuse[0].x / image.diffuse[0].x, 1, 0.01) << tilt << ", " << degrees;
    }
}

// At low order small spheres do not see that they overlap; the shares that count of them do.
TEST(SoftGi, CoincidentSpheresShareTheirLight) {
  const GBuffer gbuffer = gbuffer_of({{{}, kUp}});
  struct Row {
    double degrees, two, eight;
  };
  for (const Row& row :
       {Row{10, 0.94, 0.65}, Row{20, 0.81, 0.17}, Row{30, 0.67, 0.07}, Row{45, 0.58, 0.19}}) {
    const auto indirect = [&](std::size_t count, const SoftGiParams& params) {
      const std::vector<ProxySphere> same(count, sphere_at(kUp, row.degrees));
      return shade(gbuffer, proxies_of(same), even_sky(), params).diffuse[0].x;
    };
    const SoftGiParams paper = as_published();
    EXPECT_NEAR(indirect(2, paper) / (2 * indirect(1, paper)), row.two, 0.01) << row.degrees;
    EXPECT_NEAR(indirect(8, paper) / (8 * indirect(1, paper)), row.eight, 0.02) << row.degrees;
    for (const std::size_t count : {2u, 8u})
      EXPECT_NEAR(indirect(count, everywhere()) / indirect(1, everywhere()), 1, 1e-3) << row.degrees;
  }
}

// Normals all about, at one place.
std::vector<Point> normals_at(Vec3 position, int count) {
  std::vector<Point> out;
  for (const Vec3 normal : soft_gi::directions(count)) out.push_back({position, normal});
  return out;
}

// Light of the basis' first function alone, but for what the map's midpoints leave of the others.
scene::Environment finely_even_sky() {
  const scene::Environment sky = sky_of([](Vec3) { return Vec3{1, 1, 1}; }, 256);
  const sh::Vector light = soft_gi::project(sky)[0];
  EXPECT_NEAR(light[0], std::sqrt(4 * pi), 1e-9);
  for (int i = 1; i < sh::kCoefficients; ++i) EXPECT_NEAR(light[i], 0, 5e-5) << i;
  return sky;
}

struct Setting {
  int count;
  double largest;  // radius
};
// The most that a receiver among white spheres gets from all sides under an even sky of radiance 1, as
// radiance; and from the spheres, over what they hide of it times the most that one sends, under a coloured
// sky.
struct Most {
  double all = 0, sent = 0;
};
Most most_light(const Setting& setting, std::uint32_t seed, const SoftGiParams& params) {
  static const scene::Environment even_sky = finely_even_sky();
  const GBuffer gbuffer = gbuffer_of(normals_at({0, 0.2, 0}, 32));
  auto spheres = random_spheres(setting.count, setting.largest, seed);
  for (ProxySphere& sphere : spheres) sphere.albedo = {1, 1, 1};
  const Indirect even = shade(gbuffer, proxies_of(spheres), even_sky, params);
  const Indirect coloured = shade(gbuffer, proxies_of(spheres), coloured_sky(), params);
  const auto light = soft_gi::project(coloured_sky());
  double brightest = 0;
  for (const Point& point : normals_at({}, 1000))
    brightest = std::max(brightest, soft_gi::irradiance(light, point.normal).x / pi);
  Most out;
  for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
    const auto direct = static_cast<double>(even.direct[i].x), sent = static_cast<double>(even.diffuse[i].x);
    EXPECT_TRUE(std::isfinite(direct) && std::isfinite(sent));
    out.all = std::max(out.all, direct + sent);
    out.sent = std::max(out.sent, static_cast<double>(coloured.diffuse[i].x) - (1 - direct) * brightest);
  }
  return out;
}

// Every combination of operator, exponential and overlaps once.
TEST(SoftGi, OverlapsNeverGiveMoreThanTheSkyHolds) {
  std::uint32_t n = 0;
  for (const Setting& setting : {Setting{1, 0.6}, {4, 0.6}, {12, 0.8}, {40, 0.4}, {150, 0.3}, {400, 0.6}})
    for (int turn = 0; turn < 2; ++turn, ++n) {
      SoftGiParams params = everywhere();
      params.exponential = exponentials()[n % 2].name;
      params.emission = emissions()[n % 3].name;
      params.overlap = overlaps()[(n + n / 6) % 2].name;
      const Most most = most_light(setting, n, params);
      EXPECT_LE(most.all, 1 + 1e-4) << setting.count << " spheres, " << n;
      EXPECT_LE(most.sent, 2e-3) << setting.count << " spheres, " << n;
    }
  EXPECT_GT(most_light({400, 0.6}, 1, as_published()).all, 1.1);
}

// The exposed parts of spheres that cluster cover together what the cluster does, from afar and in the mean
// over all directions; close by each counts for more.
TEST(SoftGi, ExposedPartsMakeUpTheCluster) {
  std::vector<ProxySphere> spheres = random_spheres(6, 0.5);
  for (ProxySphere& sphere : spheres) sphere.center *= 0.3;
  const auto shares = soft_gi::exposures(spheres);
  double together = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (std::size_t level = 1; level < shares[i].size(); ++level)
      EXPECT_LE(shares[i][level], shares[i][level - 1]);
    together += static_cast<double>(shares[i].back()) * pi * spheres[i].radius * spheres[i].radius;
  }
  // Parallel rays of random directions through a square of 4 m that holds the cluster.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int hits = 0;
  const int rays = 40000;
  for (int n = 0; n < rays; ++n) {
    const double z = uniform(random), r = std::sqrt(1 - z * z), azimuth = pi * uniform(random);
    const Frame frame = frame_about({r * std::cos(azimuth), r * std::sin(azimuth), z});
    const double x = 2 * uniform(random), y = 2 * uniform(random);
    hits += std::ranges::any_of(spheres, [&](const ProxySphere& sphere) {
      const Vec3 c = frame.to_local(sphere.center);
      return std::hypot(c.x - x, c.y - y) < sphere.radius;
    });
  }
  EXPECT_NEAR(together / (16.0 * hits / rays), 1, 0.03);
  const auto alone = soft_gi::exposures({spheres[0]});
  EXPECT_EQ(alone[0].front(), 1);
  EXPECT_EQ(alone[0].back(), 1);
  const auto within = soft_gi::exposures({{{}, 1, {}}, {{0.1, 0, 0}, 0.2, {}}, {{300, 0, 0}, 1, {}}});
  EXPECT_EQ(within[0].back(), 1);
  EXPECT_EQ(within[1].back(), 0);
  EXPECT_EQ(within[2].back(), 1);
}

// Two spheres, a diameter apart, are neighbours for receivers from 2 / 0.35 radii on: of entries for 1, 2, 4,
// 8 and 16 radii, the last two. Each then hides of the other what it covers of the other half of the
// directions.
TEST(SoftGi, NeighboursAreNearerThanAShareOfTheDistance) {
  const double diameter = 2, radius = 1;
  const std::vector<ProxySphere> pair{{{0, 0, 0}, radius, {}}, {{0, diameter, 0}, radius, {}}};
  // Area that two unit disks share whose centres are 2 sin(theta) apart, over pi; mean over all directions.
  double shared = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps, half = std::sqrt(1 - cosine * cosine);
    shared += 2 * (std::acos(half) - half * std::sqrt(1 - half * half)) / pi / kSteps;
  }
  for (const soft_gi::Exposure& exposure : soft_gi::exposures(pair)) {
    for (std::size_t level = 0; level < 3; ++level) EXPECT_EQ(exposure[level], 1) << level;
    for (std::size_t level = 3; level < interop::PROXY_EXPOSURES; ++level)
      EXPECT_NEAR(exposure[level], 1 - 0.5 * shared, 0.01) << level;
  }
}

// The product with a clamped cosine of order 4 is negative beyond the horizon of a small sun.
TEST(SoftGi, LightIsNeverNegative) {
  const scene::Environment sun = sky_of([](Vec3 d) { return d.y > 0.95 ? Vec3{50, 50, 50} : Vec3{}; });
  const Vec3 averted{std::sin(125 * pi / 180), std::cos(125 * pi / 180), 0};
  Report report;
  const Indirect image = shade_soft_gi(gbuffer_of({{{}, kUp}, {{}, averted}}), Proxies{}, sun, everywhere(),
                                       device(), report, nullptr);
  EXPECT_GT(image.direct[0].x, 0.5);
  EXPECT_EQ(widen(image.direct[1]), Vec3{});
  EXPECT_EQ(report.to_json()["counts"]["clamped_values"], 1);
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
  // Exposures are by rays of fixed directions.
  const Indirect roughly = shade(gbuffer_of(points), proxies_of(spheres), sky, everywhere());
  const Indirect before = shade(gbuffer_of(points), proxies_of(spheres), sky, as_published());
  for (Point& point : points) point = {turn.direction(point.position), turn.direction(point.normal)};
  for (ProxySphere& sphere : spheres) sphere.center = turn.direction(sphere.center);
  sky.rotation = turn;
  const Indirect roughly_after = shade(gbuffer_of(points), proxies_of(spheres), sky, everywhere());
  const Indirect after = shade(gbuffer_of(points), proxies_of(spheres), sky, as_published());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(length(widen(before.direct[i]) - widen(after.direct[i])), 1e-4) << i;
    EXPECT_LE(length(widen(before.diffuse[i]) - widen(after.diffuse[i])), 1e-4) << i;
    EXPECT_LE(length(widen(roughly.direct[i]) - widen(roughly_after.direct[i])), 5e-3) << i;
    EXPECT_LE(length(widen(roughly.diffuse[i]) - widen(roughly_after.diffuse[i])), 5e-3) << i;
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

// Columns by turns on the floor and on a shelf above the proxy: normals are the same, light is not.
TEST(SoftGi, HeightsAreToldApart) {
  std::vector<Point> points = floor_points(32);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i % 32 / 8 % 2 == 1) points[i].position.y = 2;
  GBuffer gbuffer = gbuffer_of(points, 32);
  gbuffer.camera = {0, 10, 0};
  const Proxies proxies = proxies_of({{{0, 1, 0}, 0.8, {1, 1, 1}}});
  const auto mean_error = [&](const char* upsample) {
    SoftGiParams params = everywhere();
    const Indirect full = shade(gbuffer, proxies, coloured_sky(), params);
    params.rate = 4;
    params.upsample = upsample;
    const Indirect image = shade(gbuffer, proxies, coloured_sky(), params);
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      sum += length(widen(image.direct[i]) - widen(full.direct[i]));
    return sum / static_cast<double>(points.size());
  };
  const double blind = mean_error("bilinear");
  EXPECT_LT(mean_error("plane"), 0.4 * blind);
  EXPECT_LT(mean_error("bilateral"), 0.4 * blind);
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
  expect_error(ErrorCode::bad_value, {"normalisation: \"guess\"", "cosine"},
               [&] { run({.normalisation = "guess"}); });
  expect_error(ErrorCode::bad_value, {"overlap: \"guess\"", "exposed"}, [&] { run({.overlap = "guess"}); });
  expect_error(ErrorCode::invalid_data, {"proxies: anchor"}, [&] { run({}, {1, 0, 0}); });
}

}  // namespace
}  // namespace vsgl
