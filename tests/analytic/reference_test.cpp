// The reference against closed forms and an independent quadrature.

#include "reference/reference.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>
#include <numeric>

#include "reference_quadrature.h"
#include "reference_scenes.h"
#include "test_scene.h"

namespace vsgl::test {
namespace {

using interop::NDF_BECKMANN, interop::NDF_GGX, interop::NDF_PHONG;
using std::numbers::pi;

struct Case {
  scene::Scene scene;
  GBuffer gbuffer;
  Quadrature rule;
};

Case make_case(scene::Scene scene, Vec3 camera, std::vector<interop::Surface> pixels, Quadrature rule = {}) {
  scene.radius = 0;
  for (const scene::Instance& instance : scene.instances)
    for (const scene::Vertex& v : instance.vertices)
      scene.radius = std::max(
          scene.radius, std::hypot(double{v.position[0]}, double{v.position[1]}, double{v.position[2]}));
  GBuffer gbuffer = row_of(scene, camera, std::move(pixels));
  return {std::move(scene), std::move(gbuffer), std::move(rule)};
}

// A lit patch and a plane that it faces, at distance 1.
Case patch_case() {
  scene::Scene scene;
  add_parallelogram(scene, {-0.2, -0.2, 0}, {0.4, 0, 0}, {0, 0.4, 0}, matte({0.8, 0.6, 0.4}));
  add_parallelogram(scene, {-1, -1, 1}, {0, 2, 0}, {2, 0, 0}, matte({0.5, 0.7, 0.9}));
  scene.lights = {sun({-1.5, 0.2, -0.5}, {3, 4, 5})};
  std::vector<interop::Surface> pixels;
  for (const double x : {-0.9, -0.4, 0.0, 0.3, 0.8})
    for (const double y : {-0.5, 0.6})
      pixels.push_back(visible_point({x, y, 1}, {0, 0, -1}, scene.materials[1]));
  return make_case(std::move(scene), {0.5, 0, 0.5}, std::move(pixels));
}

// Floor z = 0 and wall x = 0, which see each other; both are visible.
Case corner(const scene::Material& floor, const scene::Material& wall, std::vector<LightSource> lights,
            Vec3 bend = {}) {
  scene::Scene scene;
  add_parallelogram(scene, {0, -1, 0}, {2, 0, 0}, {0, 2, 0}, floor, bend);
  add_parallelogram(scene, {0, -1, 0}, {0, 2, 0}, {0, 0, 2}, wall, bend);
  scene.lights = std::move(lights);
  std::vector<interop::Surface> pixels;
  for (const double far : {0.25, 0.7, 1.2})
    for (const double y : {-0.6, 0.1}) {
      pixels.push_back(visible_point({far, y, 0}, {0, 0, 1}, floor, bend));
      pixels.push_back(visible_point({0, y, far}, {1, 0, 0}, wall, bend));
    }
  return make_case(std::move(scene), {2.5, 0.4, 1.5}, std::move(pixels), {24, 4, {}});
}

Case planes_case() {
  return corner(matte({0.7, 0.5, 0.3}), matte({0.4, 0.6, 0.8}), {point_light({1.1, -0.3, 1.3}, {2, 3, 4})});
}

Case glossy_floor_case() {
  return corner(glossy({0.1, 0.1, 0.1}, {0.6, 0.7, 0.8}, 0.2), matte({0.4, 0.6, 0.8}),
                {spot_light({1.8, 0.2, 1.5}, {0, 0, 0.8}, std::cos(0.2), std::cos(0.6), {5, 4, 3})});
}

// Beckmann on the floor and Phong on the wall; a lamp and the sun.
Case lobes_case() {
  return corner(glossy({0.2, 0.3, 0.1}, {0.4, 0.5, 0.3}, 0.3, NDF_BECKMANN),
                glossy({0.1, 0.2, 0.3}, {0.5, 0.4, 0.6}, 0.25, NDF_PHONG),
                {point_light({1.4, 0.5, 1.2}, {2, 1, 2}), sun({-1, -0.2, -1.3}, {0.7, 0.8, 0.9})});
}

// Normals of shading that lean over by 17 degrees.
Case bent_case() {
  return corner(glossy({0.3, 0.4, 0.5}, {0.3, 0.2, 0.3}, 0.4), glossy({0.5, 0.4, 0.3}, {0.2, 0.3, 0.2}, 0.5),
                {point_light({1.1, -0.3, 1.3}, {2, 3, 4})}, {0.2, 0.2, -0.1});
}

// The floor inside a metal ring of roughness 0.1, where its caustic falls.
Case ring_case() {
  scene::GenerateOptions options;
  options.alpha = 0.1;
  scene::Scene scene = test_scene("caustic-ring", options);
  const Vec3 anchor = scene.anchor;
  std::size_t floor = 0;
  while (scene.instances[floor].name != "floor") ++floor;
  const scene::Material& material =
      scene.materials[static_cast<std::size_t>(scene.instances[floor].material)];
  std::vector<interop::Surface> pixels;
  for (const double x : {-0.75, -0.55, -0.4, -0.1, 0.2})
    for (const double z : {-0.3, 0.15})
      pixels.push_back(visible_point(Vec3{x, 0, z} - anchor, {0, 1, 0}, material));
  GBuffer gbuffer = row_of(scene, scene.camera.position, std::move(pixels));
  return {std::move(scene), std::move(gbuffer), {12, 1, {}}};
}

// The corner with a screen between, one half of which is a hole.
Case cutout_case() {
  Case c = planes_case();
  scene::Texture mask{"mask", 2, 1, false, {255, 255, 255, 255, 255, 255, 255, 0}};
  scene::Material screen = matte({});
  screen.base_color_texture = 0;
  screen.alpha_cutoff = 0.5;
  c.scene.textures = {mask};
  add_parallelogram(c.scene, {0.9, -0.8, 0.2}, {0, 1.6, 0}, {-0.4, 0, 0.6}, screen);
  // Alpha falls from 1 to 0 between the texels' centres, and rises again where the texture repeats.
  const auto is_hole = [](std::size_t instance, std::size_t triangle, double b, double d) {
    const double u = triangle == 0 ? b + d : b;
    return instance == 2 && u > 0.5;
  };
  c.rule = {24, 10, is_hole};
  return c;
}

struct Named {
  const char* name;
  Case (*make)();
};

class AgainstQuadrature : public testing::TestWithParam<Named> {};

Reference trace(const Case& c, const std::string& strategy, int samples, std::uint64_t seed) {
  Report report;
  reference::ReferenceParams params;
  params.strategy = strategy;
  params.samples = samples;
  params.seed = seed;
  return reference::trace_reference(c.scene, c.gbuffer, params, report);
}

// Of the points of a row.
struct Luminance {
  std::vector<double> value, variance;
};

std::vector<double> exact_luminance(const Case& c, const Quadrature& rule) {
  std::vector<double> out;
  const std::vector<Radiance> radiance = integrate(c.scene, c.gbuffer, rule);
  for (std::size_t i = 0; i < radiance.size(); i += kSpacing) out.push_back(radiance[i].sum().y);
  return out;
}

Luminance traced_luminance(const Reference& image) {
  Luminance out;
  for (std::size_t i = 0; i < image.variance.size(); i += kSpacing) {
    const double specular = image.radiance.specular.empty() ? 0 : to_double(image.radiance.specular[i]).y;
    out.value.push_back(to_double(image.radiance.diffuse[i]).y + specular);
    out.variance.push_back(to_double(image.variance[i]).y);
  }
  return out;
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Green light over all points and seeds: mean over the exact mean, its standard error, and root mean square
// of the errors in units of the reference's own standard deviation.
struct Score {
  double ratio = 0, noise = 0, z_rms = 0;
};

Score score(const Case& c, const std::string& strategy, int seeds, const std::vector<double>& exact) {
  double total = 0, variance = 0, squares = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Luminance found = traced_luminance(trace(c, strategy, 1024, static_cast<std::uint64_t>(seed)));
    total += sum(found.value);
    variance += sum(found.variance);
    for (std::size_t i = 0; i < exact.size(); ++i)
      squares += std::pow(found.value[i] - exact[i], 2) / found.variance[i];
  }
  const double whole = seeds * sum(exact);
  return {total / whole, std::sqrt(variance) / whole,
          std::sqrt(squares / (seeds * static_cast<double>(exact.size())))};
}

// The reference's default, mis, has enough seeds for its root mean square to be sharp.
TEST_P(AgainstQuadrature, WithinOnePercentAndTheOwnConfidence) {
  const Case c = GetParam().make();
  const std::vector<double> exact = exact_luminance(c, c.rule);
  struct Row {
    const char* strategy;
    int seeds;
    double error, z_rms;
  };
  for (const Row& row : {Row{"light", 2, 0.03, 1.45}, Row{"brdf", 2, 0.06, 1.45}, Row{"mis", 8, 0.01, 1.2}}) {
    const Score found = score(c, row.strategy, row.seeds, exact);
    std::printf("%-6s mean / exact %.5f, noise %.5f, z rms %.3f\n", row.strategy, found.ratio, found.noise,
                found.z_rms);
    EXPECT_NEAR(found.ratio, 1, std::min(row.error, 3.5 * found.noise)) << row.strategy;
    EXPECT_LT(found.z_rms, row.z_rms) << row.strategy;
    EXPECT_GT(found.z_rms, 0.7) << row.strategy << ": the variance is overstated";
  }
}

// Lambert: radiance that a lit polygon of one colour makes a matte plane reflect.
double closed_form(Vec3 x, Vec3 normal, const std::vector<Vec3>& corners, double radiance,
                   double reflectance) {
  double irradiance = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = normalise(corners[i] - x), b = normalise(corners[(i + 1) % corners.size()] - x);
    irradiance += 0.5 * radiance * std::acos(dot(a, b)) * dot(normal, normalise(cross(a, b)));
  }
  return reflectance / pi * std::abs(irradiance);
}

TEST(ClosedForm, LitPatchFacingAReceiver) {
  const Case c = patch_case();
  const LightSource& light = c.scene.lights[0];
  const double radiance = c.scene.materials[0].base_color.y / pi * light.intensity.y * -light.forward.z;
  const std::vector<Vec3> corners{{-0.2, -0.2, 0}, {0.2, -0.2, 0}, {0.2, 0.2, 0}, {-0.2, 0.2, 0}};
  std::vector<double> exact;
  for (std::size_t i = 0; i < c.gbuffer.pixels.size(); i += kSpacing)
    exact.push_back(closed_form(to_double(c.gbuffer.pixels[i].position), {0, 0, -1}, corners, radiance,
                                c.scene.materials[1].base_color.y));
  const std::vector<double> integrated = exact_luminance(c, c.rule);
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_NEAR(integrated[i] / exact[i], 1, 1e-6);
  const Score found = score(c, "mis", 4, exact);
  EXPECT_NEAR(found.ratio, 1, 0.01);
  EXPECT_LT(found.z_rms, 1.3);
}

INSTANTIATE_TEST_SUITE_P(Every, AgainstQuadrature,
                         testing::Values(Named{"patch", patch_case}, Named{"planes", planes_case},
                                         Named{"glossy_floor", glossy_floor_case}, Named{"lobes", lobes_case},
                                         Named{"bent", bent_case}, Named{"ring", ring_case},
                                         Named{"cutout", cutout_case}),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace vsgl::test
