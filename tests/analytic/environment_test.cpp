// Lights of an environment map: closed forms and quadratures.

#include "scene/environment.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cstring>
#include <functional>
#include <numbers>

#include "../unit/expect_error.h"
#include "../unit/synthetic_scene.h"
#include "base/error.h"
#include "math/interop_vec.h"
#include "math/microfacet.h"
#include "math/sg.h"
#include "scene/transform.h"
#include "stages/lights/lights.h"
#include "stages/shading/shading.h"
#include "stages/visibility/visibility.h"

namespace vsgl {
namespace {

using interop::Light;
using scene::Environment;
using test::add_quad;
using test::expect_error;

constexpr double pi = std::numbers::pi;

gpu::Device& device() {
  static gpu::Device device({.compute_only = true});
  return device;
}

// A map of the radiance in each texel's middle.
Environment make_map(int height, const std::function<Vec3(Vec3 direction)>& radiance,
                     Vec3 rotation_deg = {}) {
  Environment map{2 * height, height, {}, scene::rotation_xyz_deg(rotation_deg)};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < map.width; ++column)
      map.radiance.push_back(
          radiance(scene::environment_direction((column + 0.5) / map.width, (row + 0.5) / height)));
  return map;
}

Vec3 even(Vec3) {
  return {2, 3, 1};
}
// Smooth, of another colour on each side.
Vec3 smooth(Vec3 d) {
  return {1 + 0.8 * d.x, 1 - 0.5 * d.y, 1 + 0.6 * d.z};
}

// Black but for one texel.
Environment one_texel(int height, int column, int row, Vec3 radiance) {
  Environment map = make_map(height, [](Vec3) { return Vec3{}; });
  map.radiance[static_cast<std::size_t>(row * map.width + column)] = radiance;
  return map;
}

Lights lights_of(const Environment& map, LightsParams params = {}) {
  Report report;
  params.method = "environment";
  return generate_environment_lights(map, params, device(), report);
}

Vec3 power_of(const Lights& lights) {
  Vec3 sum;
  for (const Light& light : lights.lights) sum += to_double(light.power_diffuse);
  return sum;
}

// Of the pixels' normals: n directions spread evenly over the sphere.
std::vector<Vec3> directions(int n) {
  std::vector<Vec3> out;
  for (int i = 0; i < n; ++i) {
    const double y = 1 - (2 * i + 1.0) / n, turn = pi * (1 + std::sqrt(5)) * i, r = std::sqrt(1 - y * y);
    out.push_back({r * std::cos(turn), y, r * std::sin(turn)});
  }
  return out;
}

constexpr double slant = 0.9;  // of the view against each pixel's normal, rad

// Pixels about the camera at the origin, all seen at the same angle; `alpha` 0: diffuse.
GBuffer pixels_of(const std::vector<Vec3>& normals, double alpha = 0) {
  GBuffer out;
  out.width = static_cast<int>(normals.size());
  out.height = 1;
  for (const Vec3& n : normals) {
    const Vec3 across = normalise(cross(n, std::abs(n.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    interop::Surface s{};
    s.normal = s.shading_normal = to_float(n);
    s.position = to_float(-(n * std::cos(slant) + across * std::sin(slant)));
    s.diffuse = {1, 1, 1};
    s.depth = 1;
    s.alpha = alpha > 0 ? static_cast<float>(alpha) : 1.0f;
    if (alpha > 0) s.specular = {1, 1, 1}, s.ndf = interop::NDF_GGX;
    out.pixels.push_back(s);
  }
  return out;
}

Indirect shade_with(const Lights& lights, const GBuffer& gbuffer, const Visibility* visibility = nullptr) {
  Report report;
  return shade(gbuffer, lights, visibility, {.light_model = "vsgl"}, device(), report);
}

Vec3 view_of(const GBuffer& gbuffer, std::size_t pixel) {
  return normalise(-to_double(gbuffer.pixels[pixel].position));
}

// Integral of radiance, specular BRDF and cosine over the map's texels, each split into 2x2.
Vec3 specular_quadrature(const Environment& map, const GBuffer& gbuffer, std::size_t pixel) {
  const interop::Surface& s = gbuffer.pixels[pixel];
  const Vec3 n = to_double(s.normal), view = view_of(gbuffer, pixel);
  Vec3 sum;
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      double answer = 0;
      for (int k = 0; k < 4; ++k) {
        const double u = (column + 0.25 + 0.5 * (k % 2)) / map.width,
                     v = (row + 0.25 + 0.5 * (k / 2)) / map.height;
        const Vec3 w = map.rotation.direction(scene::environment_direction(u, v));
        answer += dot(n, w) > 0 ? specular_brdf_cos(s.ndf, static_cast<double>(s.alpha), n, view, w) : 0.0;
      }
      sum += map.at(column, row) * (scene::environment_texel(map, column, row).solid_angle * answer / 4);
    }
  return sum;
}

// Largest difference over all pixels and channels, relative to `expected`.
template <class Expected>
double worst(const std::vector<interop::vec3>& image, Expected expected) {
  double error = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Vec3 found = to_double(image[i]), wanted = expected(i);
    for (std::size_t c = 0; c < 3; ++c)
      error = std::max(error, std::abs(to_array(found)[c] / to_array(wanted)[c] - 1));
  }
  return error;
}

TEST(Environment, PowersAddUpInEachChannel) {
  const Environment map = make_map(64, smooth);
  for (const char* points : {"lattice", "random"})
    for (const int count : {1, 7, 512}) {
      const Vec3 sum = power_of(lights_of(map, {.count = count, .points = points}));
      EXPECT_NEAR(sum.x / (4 * pi), 1, 1e-6) << count;  // the odd terms integrate to 0
      EXPECT_NEAR(sum.y / (4 * pi), 1, 1e-6) << count;
      EXPECT_NEAR(sum.z / (4 * pi), 1, 1e-6) << count;
    }
}

// 19 rows of 4x4 texels fit into 32, as do 76 into 128.
TEST(Environment, LargerMapsAreReducedExactly) {
  const Environment odd = make_map(76, even);
  for (const int size : {32, 128}) {
    const Lights lights = lights_of(odd, {.count = 2, .power = "paper", .environment_size = size});
    ASSERT_EQ(lights.lights.size(), 2u);
    EXPECT_NEAR(power_of(lights).y / (4 * pi * even({}).y), 1, 1e-5);
    EXPECT_NEAR(lights.lights[0].diffuse_sharpness, 11.0 / 6, 1e-3);
  }
}

// The luminance of each light is the same, and its axis lies where the light comes from.
TEST(Environment, DistributionFollowsTheMap) {
  const Environment map = make_map(64, [](Vec3 d) { return Vec3{1, 1, 1} * (d.z > 0 ? 3.0 : 1.0); });
  const Lights lights = lights_of(map);
  ASSERT_EQ(lights.lights.size(), 1024u);
  double front = 0;
  for (const Light& light : lights.lights) front += light.diffuse_axis.z < 0 ? 1 : 0;
  EXPECT_NEAR(front / 1024, 0.75, 0.01);
}

TEST(Environment, EvenMapGivesEvenIrradiance) {
  const Lights lights = lights_of(make_map(64, even));
  const Indirect image = shade_with(lights, pixels_of(directions(200)));
  EXPECT_LT(worst(image.diffuse, [](std::size_t) { return even({}); }), 0.01);  // pi L albedo / pi
}

// Each takes one half of the map, whose mean direction has the length 1/2: sharpness 11/6 by the cubic.
TEST(Environment, TwoLightsHalveAnEvenMap) {
  const Lights lights = lights_of(make_map(64, even), {.count = 2});
  ASSERT_EQ(lights.lights.size(), 2u);
  for (const Light& light : lights.lights) {
    EXPECT_NEAR(std::abs(light.diffuse_axis.x), 1, 1e-6);
    EXPECT_NEAR(light.diffuse_sharpness, 11.0 / 6, 1e-4);
  }
  const std::vector<Vec3> normals = directions(50);
  const Indirect image = shade_with(lights, pixels_of(normals));
  EXPECT_LT(worst(image.diffuse,
                  [&](std::size_t i) {
                    const double c = normals[i].x;
                    return even({}) * (2 * (cosine_mean(c, 11.0 / 6) + cosine_mean(-c, 11.0 / 6)));
                  }),
            1e-3);
}

// Root mean square of the relative difference, over all pixels and channels. Where few lights make a pixel
// their spacing shows: worst where the lobe is narrow, or looks at a pole of the map.
template <class Expected>
double deviation(const std::vector<interop::vec3>& image, Expected expected) {
  double sum = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Vec3 found = to_double(image[i]), wanted = expected(i);
    for (std::size_t c = 0; c < 3; ++c) sum += std::pow(to_array(found)[c] / to_array(wanted)[c] - 1, 2);
  }
  return std::sqrt(sum / (3 * static_cast<double>(image.size())));
}

// Of the specular light of 30 pixels from the quadrature.
double specular_deviation(const Environment& map, double alpha) {
  const GBuffer gbuffer = pixels_of(directions(30), alpha);
  const Indirect image = shade_with(lights_of(map), gbuffer);
  return deviation(image.specular, [&](std::size_t i) { return specular_quadrature(map, gbuffer, i); });
}

TEST(Environment, WhiteFurnaceOfAGlossyReceiver) {
  const Environment map = make_map(64, even);
  EXPECT_LT(specular_deviation(map, 0.2), 0.05);
  EXPECT_LT(specular_deviation(map, 0.4), 0.02);
  EXPECT_LT(specular_deviation(map, 0.8), 0.01);
}

TEST(Environment, GlossyReceiverUnderASmoothMap) {
  const Environment map = make_map(64, smooth, {20, 130, 0});
  EXPECT_LT(specular_deviation(map, 0.2), 0.05);
  EXPECT_LT(specular_deviation(map, 0.4), 0.02);
  EXPECT_LT(specular_deviation(map, 0.8), 0.012);
}

TEST(Environment, BrightTexelIsADirectionalLight) {
  const int column = 23, row = 40;  // of 256 x 128
  const Environment map = one_texel(128, column, row, {1000, 500, 2000});
  const auto texel = scene::environment_texel(map, column, row);
  const Vec3 towards = scene::environment_direction((column + 0.5) / 256, (row + 0.5) / 128);
  const Lights lights = lights_of(map, {.count = 16});
  for (const Light& light : lights.lights)
    EXPECT_GT(dot(-to_double(light.diffuse_axis), towards), std::cos(0.01));
  std::vector<Vec3> normals;
  for (const Vec3& n : directions(60))
    if (dot(n, towards) > 0.2) normals.push_back(n);
  const GBuffer gbuffer = pixels_of(normals, 0.3);
  const Indirect image = shade_with(lights, gbuffer);
  const Vec3 facing = Vec3{1000, 500, 2000} * texel.solid_angle;  // irradiance
  EXPECT_LT(worst(image.diffuse, [&](std::size_t i) { return facing * (dot(normals[i], towards) / pi); }),
            0.005);
  const auto specular = [&](std::size_t i) {
    return facing * specular_brdf_cos(interop::NDF_GGX, 0.3, normals[i], view_of(gbuffer, i), towards);
  };
  EXPECT_LT(worst(image.specular, specular), 0.02);
}

TEST(Environment, RotatedMapRotatesTheLights) {
  const Vec3 angles{30, -70, 15};
  const Lights plain = lights_of(make_map(64, smooth)), turned = lights_of(make_map(64, smooth, angles));
  const Mat4 rotation = scene::rotation_xyz_deg(angles);
  ASSERT_EQ(plain.lights.size(), turned.lights.size());
  for (std::size_t i = 0; i < plain.lights.size(); ++i) {
    const Vec3 expected = rotation.direction(to_double(plain.lights[i].diffuse_axis));
    EXPECT_LT(length(to_double(turned.lights[i].diffuse_axis) - expected), 1e-4) << i;
  }
}

// A smooth surface shows the environment at the mirrored view, with the lights' lobes between: their exact
// sum is up to 0.286 off.
TEST(Environment, SmoothSurfaceMirrorsTheMap) {
  const Environment map = make_map(64, smooth);
  const GBuffer gbuffer = pixels_of(directions(40), 0.02);
  const Indirect image = shade_with(lights_of(map, {.count = 4096}), gbuffer);
  const auto mirrored = [&](std::size_t i) {
    const Vec3 n = to_double(gbuffer.pixels[i].normal), view = view_of(gbuffer, i);
    return smooth(2 * dot(n, view) * n - view);
  };
  EXPECT_LT(worst(image.specular, mirrored), 0.29);
}

TEST(Environment, SameBytesOnAnyNumberOfThreads) {
  const Environment map = make_map(64, smooth);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Lights one = lights_of(map);
  omp_set_num_threads(2);
  const Lights two = lights_of(map);
  omp_set_num_threads(threads);
  ASSERT_EQ(one.lights.size(), two.lights.size());
  EXPECT_EQ(std::memcmp(one.lights.data(), two.lights.data(), one.lights.size() * sizeof(Light)), 0);
}

// A well: pixels on its floor, walls as high as it is wide.
scene::Scene make_well() {
  scene::Scene scene;
  scene.radius = 2;
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  add_quad(scene, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0});
  add_quad(scene, {-1, 0, 1}, {2, 0, 0}, {0, 2, 0});
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {0, 2, 0});
  add_quad(scene, {1, 0, -1}, {0, 0, 2}, {0, 2, 0});
  return scene;
}

GBuffer well_floor() {
  GBuffer out = pixels_of({{0, 1, 0}});
  out.pixels[0].position = {};
  out.camera = {0, 1, 0};
  out.scene_radius = 2;
  return out;
}

Visibility see(const scene::Scene& scene, const GBuffer& gbuffer, const Lights& lights, const char* method) {
  Report report;
  return build_visibility({scene, lights, &gbuffer}, {.method = method}, nullptr, report);
}

// From the middle of the floor the opening is the square of directions with |x|, |z| < y / 2.
TEST(Environment, RaysFindTheOpeningOfAWell) {
  const scene::Scene scene = make_well();
  const GBuffer gbuffer = well_floor();
  const Lights lights = lights_of(make_map(64, even), {.count = 4096});
  const auto bits = std::get<VisibilityBits>(see(scene, gbuffer, lights, "auto"));
  std::size_t open = 0;
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const Vec3 w = -to_double(lights.lights[i].diffuse_axis);
    const bool expected = w.y > 0 && std::max(std::abs(w.x), std::abs(w.z)) < w.y / 2;
    EXPECT_EQ(bits.visible(i, 0), expected) << w.x << " " << w.y << " " << w.z;
    open += expected;
  }
  EXPECT_GT(open, 200u);
  const Visibility visibility = bits;
  const double lit = luminance(to_double(shade_with(lights, gbuffer, &visibility).diffuse[0])),
               bare = luminance(to_double(shade_with(lights, gbuffer).diffuse[0]));
  // Form factor of a square of half side 1 from 2 below its middle.
  const double share = 4 / pi * (1 / std::sqrt(5.0)) * std::atan(1 / std::sqrt(5.0));
  EXPECT_NEAR(lit / bare, share, 0.03);
}

// On open ground nothing is lost, whatever the lights' width.
TEST(Environment, OpenGroundIsLitByTheUpperHalf) {
  scene::Scene scene;
  scene.radius = 2;
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  const GBuffer gbuffer = well_floor();
  for (const int count : {16, 1024}) {
    const Lights lights = lights_of(make_map(64, even), {.count = count});
    const Visibility visibility = see(scene, gbuffer, lights, "raytraced");
    const double lit = luminance(to_double(shade_with(lights, gbuffer, &visibility).diffuse[0])),
                 bare = luminance(to_double(shade_with(lights, gbuffer).diffuse[0]));
    EXPECT_NEAR(lit / bare, 1, 1e-3) << count;
  }
}

TEST(Environment, OtherStagesRefuse) {
  const scene::Scene scene = make_well();
  const GBuffer gbuffer = well_floor();
  const Lights lights = lights_of(make_map(8, even), {.count = 4});
  Report report;
  for (const char* method : {"ism", "rays"})
    expect_error(ErrorCode::bad_value, {method}, [&] { see(scene, gbuffer, lights, method); });
  for (const char* model : {"fvpl", "vpl", "vsgl-2014"})
    expect_error(ErrorCode::bad_value, {model, "environment"},
                 [&] { shade(gbuffer, lights, nullptr, {.light_model = model}, device(), report); });
  expect_error(ErrorCode::missing_option, {"environment"},
               [&] { generate_lights(Rsm{}, nullptr, {.method = "environment"}, &device(), report); });
  expect_error(ErrorCode::bad_value, {"tree", "environment"},
               [&] { generate_environment_lights(make_map(8, even), {.method = "tree"}, device(), report); });
  expect_error(ErrorCode::out_of_range, {"environment_size"},
               [&] { lights_of(make_map(8, even), {.environment_size = 100}); });
}

}  // namespace
}  // namespace vsgl
