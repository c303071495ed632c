// Direct light of sphere lights: the reference against closed forms, and the lobes of shade against the
// reference, as in [Tokuyoshi 2014s, Fig. 1].

#include <gtest/gtest.h>

#include <numbers>

#include "../unit/expect_error.h"
#include "reference/sphere_lights.h"
#include "reference_scenes.h"
#include "stages/lights/lights.h"
#include "stages/shading/shading.h"

namespace vsgl::reference {
namespace {

using namespace test;
using std::numbers::pi;

constexpr double kRadius = 0.1;  // m
const Vec3 kCentre{0, 0, 0.5}, kRadiance{30, 20, 10};

struct Plane {
  scene::Scene scene;
  GBuffer gbuffer;
};

// The plane z = 0 at the places `at`, seen from `camera`.
Plane plane(const scene::Material& material, Vec3 camera, const std::vector<Vec3>& at) {
  Plane out;
  add_parallelogram(out.scene, {-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, material);
  out.scene.radius = 30;
  out.scene.sphere_lights = {{"lamp", kCentre, kRadius, kRadiance}};
  std::vector<interop::Surface> points;
  for (const Vec3 position : at) points.push_back(visible_point(position, {0, 0, 1}, out.scene.materials[0]));
  out.gbuffer = row_of(out.scene, camera, points);
  return out;
}

Reference trace(const Plane& p, const std::string& strategy, int samples) {
  Report report;
  ReferenceParams params;
  params.strategy = strategy;
  params.samples = samples;
  return trace_sphere_lights(p.scene, p.gbuffer, params, report);
}

// A sphere wholly above the horizon: E = pi L (radius / d)^2 cos.
TEST(SphereLight, IrradianceIsThatOfTheClosedForm) {
  const std::vector<Vec3> places{{0, 0, 0}, {0.3, 0, 0}, {1, 0.5, 0}, {0, 0, 0.39}};
  const Plane p = plane(matte({0.5, 0.5, 0.5}), {3, 0, 2}, places);
  for (const char* strategy : {"light", "brdf", "mis"}) {
    const Reference truth = trace(p, strategy, 1 << 17);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Vec3 v = kCentre - places[i];
      const double d2 = dot(v, v), exact = 0.5 * 30 * kRadius * kRadius / d2 * v.z / std::sqrt(d2);
      const double spread = std::sqrt(static_cast<double>(truth.variance[kSpacing * i].x));
      EXPECT_NEAR(static_cast<double>(truth.radiance.diffuse[kSpacing * i].x), exact,
                  5 * spread + 1e-3 * exact)
          << strategy << " " << i;
      EXPECT_LT(spread, 0.05 * exact);
    }
  }
}

TEST(SphereLight, IsHiddenByWhatStandsBefore) {
  Plane p = plane(matte({0.5, 0.5, 0.5}), {3, 0, 2}, {{0, 0, 0}});
  add_parallelogram(p.scene, {-1, -1, 0.2}, {2, 0, 0}, {0, 2, 0}, matte({0.5, 0.5, 0.5}));
  EXPECT_EQ(trace(p, "light", 256).radiance.diffuse[0].x, 0);
}

gpu::Device& device() {
  static gpu::Device shared({.compute_only = true});
  return shared;
}

Indirect shaded(const Plane& p, const ShadingParams& params, const Visibility* visibility = nullptr) {
  Report report;
  const Lights lights = generate_sphere_lights(p.scene, {.method = "sphere-lights"}, report);
  return shade(p.gbuffer, lights, visibility, params, device(), report);
}

// Mean error of the specular light over its mean.
double error_of(const std::string& lobe, const Plane& p, const Reference& truth) {
  const Indirect image = shaded(p, {.light_model = "vsgl", .specular_lobe = lobe, .cbr = 0});
  double error = 0, sum = 0;
  for (std::size_t i = 0; i < truth.radiance.specular.size(); ++i) {
    error += std::abs(static_cast<double>(image.specular[i].x - truth.radiance.specular[i].x));
    sum += static_cast<double>(truth.radiance.specular[i].x);
  }
  return error / sum;
}

// The highlight on a plane of Phong exponent 1000 at a grazing angle is elongated: round SGs miss it.
TEST(SphereLight, HighlightIsThatOfAnisotropicLobes) {
  std::vector<Vec3> places;
  for (int y = -20; y <= 20; ++y)
    for (int x = 0; x < 40; ++x) places.push_back({0.15 + 0.2 * x, 0.02 * y, 0});
  const scene::Material phong = glossy({}, {0.6, 0.6, 0.6}, std::sqrt(2 / 1002.0), interop::NDF_PHONG);
  const Plane p = plane(phong, {8, 0, 0.6}, places);
  const Reference truth = trace(p, "mis", 512);
  const double sg = error_of("sg", p, truth), asg = error_of("asg", p, truth);
  const double both = error_of("asg-asg", p, truth), filtered = error_of("ndf-filter", p, truth);
  const double best = error_of("auto", p, truth);
  std::printf("mean error: sg %.3f, asg %.3f, asg-asg %.3f, ndf-filter %.3f, auto %.3f\n", sg, asg, both,
              filtered, best);
  EXPECT_LT(asg, 0.5 * sg);
  EXPECT_LT(both, 0.5 * sg);
  EXPECT_LT(filtered, 0.5 * sg);
  EXPECT_LT(best, 0.5 * sg);
}

TEST(SphereLight, FluenceIsThatOfTheSphere) {
  const std::vector<Vec3> places{{0, 0, 0}, {0.5, 0, 0}, {2, 0, 0}};
  const Plane p = plane(matte({0.5, 0.5, 0.5}), {3, 0, 2}, places);
  const Reference truth = trace(p, "light", 1024);
  const Indirect image = shaded(p, {.light_model = "vsgl", .cbr = 0});
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR(image.diffuse[kSpacing * i].x / truth.radiance.diffuse[kSpacing * i].x, 1, 0.02) << i;
}

TEST(SphereLight, IsOfTheSceneAlone) {
  Plane p = plane(matte({0.5, 0.5, 0.5}), {3, 0, 2}, {{0, 0, 0}});
  Report report;
  expect_error(ErrorCode::bad_value, {"tree", "sphere-lights"},
               [&] { generate_sphere_lights(p.scene, {.method = "tree"}, report); });
  expect_error(ErrorCode::missing_option, {"sphere-lights"},
               [&] { generate_lights(Rsm{}, nullptr, {.method = "sphere-lights"}, nullptr, report); });
  p.scene.sphere_lights.clear();
  expect_error(ErrorCode::bad_light, {"sphere_lights"},
               [&] { generate_sphere_lights(p.scene, {.method = "sphere-lights"}, report); });
  expect_error(ErrorCode::bad_light, {"sphere_lights"}, [&] { trace(p, "mis", 16); });
}

TEST(SphereLight, IsRefusedWhereItHasNoSurface) {
  const Plane p = plane(matte({0.5, 0.5, 0.5}), {3, 0, 2}, {{0, 0, 0}});
  expect_error(ErrorCode::bad_value, {"vpl", "vsgl"}, [&] { shaded(p, {.light_model = "vpl", .cbr = 0}); });
  expect_error(ErrorCode::bad_value, {"cbr", "sphere"}, [&] { shaded(p, {.light_model = "vsgl"}); });
  ShadowMaps maps;
  maps.views.resize(1);
  const Visibility visibility = maps;
  expect_error(ErrorCode::bad_value, {"visibility", "sphere"},
               [&] { shaded(p, {.light_model = "vsgl", .cbr = 0}, &visibility); });
}

}  // namespace
}  // namespace vsgl::reference
