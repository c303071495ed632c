// Shadow maps: an analytic occluder.

#include "math/frame.h"
#include "math/octahedral.h"
#include "run.h"

namespace vsgl {
namespace {

constexpr int kTile = 64;

// Tiles of two lights; the second one's map holds a square of half width `half` at height `height` above its
// origin.
Visibility square_occluder(const Lights& lights, Vec3 axis, double height, double half) {
  ShadowMaps maps;
  maps.tile = kTile;
  maps.columns = static_cast<int>(lights.lights.size());
  for (const auto& light : lights.lights) maps.views.push_back({light.position, test::to_float(axis)});
  maps.inverse_distance.assign(static_cast<std::size_t>(kTile * kTile * maps.columns), 0.0f);
  const Frame frame = frame_about(axis);
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < kTile; ++x) {
      const Vec3 d = hemi_octahedral_decode({2 * (x + 0.5) / kTile - 1, 2 * (y + 0.5) / kTile - 1});
      const double t = height / d.z;
      const Vec3 hit = frame.to_world(t * d);
      const bool blocked = std::abs(hit.x) < half && std::abs(hit.z) < half;
      if (blocked)
        maps.inverse_distance[static_cast<std::size_t>(y * kTile * maps.columns + kTile + x)] =
            static_cast<float>(1 / t);
    }
  return maps;
}

// A ceiling at height 1 lit from the floor's centre by the second of two lights; the first has no power.
struct Ceiling {
  GBuffer gbuffer;
  Lights lights;

  explicit Ceiling(int size) {
    gbuffer.width = gbuffer.height = size;
    gbuffer.scene_radius = 2;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        interop::Surface s;
        s.position = {static_cast<float>((x + 0.5) / size * 2 - 1), 1,
                      static_cast<float>((y + 0.5) / size * 2 - 1)};
        s.normal = s.shading_normal = {0, -1, 0};
        s.diffuse = {0.5f, 0.5f, 0.5f};
        s.alpha = 1;
        s.id = 0;
        gbuffer.pixels.push_back(s);
      }
    interop::Light light;
    light.normal = light.shading_normal = light.diffuse_axis = light.incident = {0, 1, 0};
    light.alpha = 1;
    light.diffuse_sharpness = interop::LAMBDA_DIFFUSE;
    light.variance = 1e-4f;
    lights.lights.push_back(light);
    light.power_diffuse = {1, 1, 1};
    lights.lights.push_back(light);
    lights.scene_radius = 2;
  }
};

// Shadow of the square of half width 0.2 at height 0.5 on the ceiling at height 1: half width 0.4.
TEST(Shadow, CoversTheProjectedOccluder) {
  constexpr int size = 64;
  const Ceiling scene(size);
  const Visibility maps = square_occluder(scene.lights, {0, 1, 0}, 0.5, 0.2);
  for (const char* method : {"fvpl", "vpl", "vsgl", "vsgl-2014"}) {
    SCOPED_TRACE(method);
    const ShadingParams params{.light_model = method};
    const Indirect lit = test::shade_box(scene.gbuffer, scene.lights, params);
    const Indirect shadowed = test::shade_box(scene.gbuffer, scene.lights, params, &maps);
    double area = 0;
    for (int i = 0; i < size * size; ++i) {
      const auto& s = scene.gbuffer.pixels[static_cast<std::size_t>(i)];
      const double share = static_cast<double>(shadowed.diffuse[static_cast<std::size_t>(i)].x) /
                           static_cast<double>(lit.diffuse[static_cast<std::size_t>(i)].x);
      const float reach = std::max(std::abs(s.position.x), std::abs(s.position.z));
      ASSERT_TRUE(share >= 0 && share < 1 + 1e-6);
      ASSERT_TRUE(reach > 0.33f || share < 1e-6) << i << " " << share;
      ASSERT_TRUE(reach < 0.47f || share > 1 - 1e-6) << i << " " << share;
      area += (1 - share) * 4 / (size * size);
    }
    EXPECT_NEAR(area, 0.64, 0.04);
  }
}

TEST(Shadow, NothingIsLitBehindTheLight) {
  const Ceiling scene(8);
  const Visibility behind = square_occluder(scene.lights, {0, -1, 0}, 0.5, 0.0);
  for (const auto& radiance : test::shade_box(scene.gbuffer, scene.lights, {}, &behind).diffuse)
    EXPECT_EQ(radiance.x, 0.0f);
}

// A map that holds the ceiling itself: biases keep it lit.
TEST(Shadow, ASurfaceDoesNotShadowItself) {
  const Ceiling scene(32);
  Visibility maps = square_occluder(scene.lights, {0, 1, 0}, 1.0, 100);
  const auto image = [&] { return test::shade_box(scene.gbuffer, scene.lights, {}, &maps).diffuse; };
  const auto lit = test::shade_box(scene.gbuffer, scene.lights, {}).diffuse;
  const auto shadowed = image();
  for (std::size_t i = 0; i < lit.size(); ++i) EXPECT_NEAR(shadowed[i].x / lit[i].x, 1.0f, 1e-6f) << i;

  auto& biases = std::get<ShadowMaps>(maps);
  biases.normal_offset = biases.slope_bias = biases.relative_bias = 0;
  const auto unbiased = image();
  int dark = 0;
  for (std::size_t i = 0; i < lit.size(); ++i) dark += unbiased[i].x < 0.9f * lit[i].x;
  EXPECT_GT(dark, 100);
}

// More maps (290 MB) than a shader sees at a time: every third light from the 500th on is open, the maps of
// the others hide everything.
TEST(Shadow, EachOfManyLightsLooksUpItsOwnMap) {
  constexpr std::size_t count = 1100;
  Ceiling scene(4);
  interop::Light light = scene.lights.lights[1];
  const double one =
      static_cast<double>(test::shade_box(scene.gbuffer, scene.lights, {.light_model = "vpl"}).diffuse[5].x);
  scene.lights.lights.assign(count, light);

  ShadowMaps maps;
  maps.tile = 256;
  maps.columns = 34;
  for (std::size_t i = 0; i < count; ++i) maps.views.push_back({light.position, {0, 1, 0}});
  const std::size_t side = 256, row = 34 * side;
  maps.inverse_distance.assign(row * side * static_cast<std::size_t>(maps.rows()), 100.0f);
  std::size_t open = 0;
  for (std::size_t i = 500; i < count; i += 3, ++open)
    for (std::size_t y = 0; y < side; ++y)
      std::fill_n(maps.inverse_distance.begin() +
                      static_cast<std::ptrdiff_t>((i / 34 * side + y) * row + i % 34 * side),
                  side, 0.0f);
  const Visibility visibility = maps;
  const Indirect image = test::shade_box(scene.gbuffer, scene.lights, {.light_model = "vpl"}, &visibility);
  EXPECT_NEAR(static_cast<double>(image.diffuse[5].x) / one, static_cast<double>(open), 1e-3);
}

}  // namespace
}  // namespace vsgl
