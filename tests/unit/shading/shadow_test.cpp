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
  for (const char* method : {"vpl", "vsgl", "vsgl-2014"}) {
    SCOPED_TRACE(method);
    const ShadingParams params{.method = method};
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

}  // namespace
}  // namespace vsgl
