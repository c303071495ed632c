// Exact visibility: against the tracer pair by pair, and against closed forms.

#include <gtest/gtest.h>

#include <bit>

#include "../expect_error.h"
#include "lit_room.h"
#include "stages/visibility/visibility.h"
#include "trace/tracer.h"

namespace vsgl {
namespace {

using namespace vsgl::test;

// n x n pixels on the ceiling, looking down.
GBuffer ceiling(int n) {
  std::vector<interop::Surface> pixels;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      pixels.push_back(pixel_at({-1 + 2 * (i + 0.5) / n, -1 + 2 * (j + 0.5) / n, 2}, {0, 0, -1}));
  return gbuffer_of(std::move(pixels), n);
}

VisibilityBits trace(const scene::Scene& scene, const std::vector<interop::Light>& lights,
                     const GBuffer& gbuffer, Report& report, bool skip = true) {
  const VisibilityParams params{.method = "raytraced", .skip_powerless = skip};
  return std::get<VisibilityBits>(
      build_visibility({scene, make_lights(scene, lights), &gbuffer}, params, nullptr, report));
}
VisibilityBits trace(const scene::Scene& scene, const std::vector<interop::Light>& lights,
                     const GBuffer& gbuffer) {
  Report report;
  return trace(scene, lights, gbuffer, report);
}

std::vector<WallPoint> random_walls(int n, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<WallPoint> points;
  for (int i = 0; i < n; ++i) {
    const double wall = unit(random), s = unit(random), t = unit(random);
    points.push_back(wall_point(room_low, room_high, wall, s, t));
  }
  return points;
}

// 77 lights: the third word is not full.
TEST(Raytraced, EachBitIsWhatTheTracerSays) {
  scene::Scene scene = room();
  add_box(scene, {-0.7, -0.6, 0}, {-0.2, 0, 0.6});
  add_sphere(scene, {0.3, 0.2, 1}, 0.4);
  std::vector<interop::Light> lights;
  for (const WallPoint& p : random_walls(77, 1)) lights.push_back(make_light(p.position, p.normal));
  std::vector<interop::Surface> pixels;
  for (const WallPoint& p : random_walls(300, 2)) pixels.push_back(pixel_at(p.position, p.normal));
  const GBuffer gbuffer = gbuffer_of(std::move(pixels), 20);
  const VisibilityBits bits = trace(scene, lights, gbuffer);
  ASSERT_EQ(bits.words_per_pixel(), 3);
  const trace::Tracer tracer(scene);
  std::size_t visible = 0, occluded = 0;
  for (std::size_t i = 0; i < lights.size(); ++i)
    for (std::size_t j = 0; j < gbuffer.pixels.size(); ++j) {
      const Vec3 x = widen(gbuffer.pixels[j].position), n_x = widen(gbuffer.pixels[j].normal);
      const Vec3 y = widen(lights[i].origin), n_y = widen(lights[i].normal);
      const bool facing = dot(y - x, n_x) > 0 && dot(x - y, n_y) > 0;
      const bool hidden = tracer.occluded(x, n_x, y, n_y);
      ASSERT_EQ(bits.visible(i, j), facing && !hidden) << i << " " << j;
      visible += bits.visible(i, j);
      occluded += facing && hidden;
    }
  EXPECT_GT(visible, 5000u);
  EXPECT_GT(occluded, 1000u);
}

// The shadow of a sphere: where the segment passes its centre by less than the radius. The mesh is inscribed:
// 1% is left out.
TEST(Raytraced, ShadowOfASphere) {
  scene::Scene scene = room();
  const Vec3 centre{0.1, 0.05, 1}, light{-0.3, 0.2, 0};
  add_sphere(scene, centre, 0.35, 128);
  const GBuffer gbuffer = ceiling(64);
  const VisibilityBits bits = trace(scene, {make_light(light, {0, 0, 1})}, gbuffer);
  int hidden = 0, left_out = 0;
  for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
    const Vec3 u = normalise(widen(gbuffer.pixels[i].position) - light), v = centre - light;
    const double passing = length(v - dot(v, u) * u) / 0.35;
    hidden += passing < 1;
    if (std::abs(passing - 1) < 0.01)
      ++left_out;
    else
      ASSERT_EQ(bits.visible(0, i), passing > 1) << i;
  }
  EXPECT_GT(hidden, 500);
  EXPECT_LT(left_out, 80);
}

// A wall from the floor to half the height, across the room: it hides what lies below the line over its top.
TEST(Raytraced, ShadowOfAWall) {
  scene::Scene scene = room();
  add_quad(scene, {0, -1, 0}, {0, 2, 0}, {0, 0, 1});
  const auto light = make_light({-0.5, 0.3, 0}, {0, 0, 1});
  std::vector<interop::Surface> pixels;
  for (int i = 0; i < 64; ++i) pixels.push_back(pixel_at({1, 0.1, 2 * (i + 0.5) / 64}, {-1, 0, 0}));
  const VisibilityBits bits = trace(scene, {light}, gbuffer_of(std::move(pixels), 64));
  // The line from (-0.5, 0) over (0, 1) would reach x = 1 at height 3: above the ceiling, so all is hidden.
  for (std::size_t i = 0; i < 64; ++i) EXPECT_FALSE(bits.visible(0, i)) << i;
  const GBuffer above = ceiling(40);
  const VisibilityBits seen = trace(scene, {light}, above);
  for (std::size_t i = 0; i < above.pixels.size(); ++i)
    EXPECT_EQ(seen.visible(0, i), above.pixels[i].position.x < 0.5f) << i;
}

TEST(Raytraced, NothingIsSeenBehindEitherHorizon) {
  scene::Scene sheet;  // has no back side: only the horizons hide
  sheet.radius = 2;
  add_quad(sheet, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  const auto light = make_light({0, 0, 0}, {0, 0, 1});
  const GBuffer gbuffer =
      gbuffer_of({pixel_at({0.1, 0.2, 1}, {0, 0, -1}), pixel_at({0.1, 0.2, 1}, {0, 0, 1}),
                  pixel_at({0.1, 0.2, -1}, {0, 0, 1}), pixel_at({0.5, 0.2, 0}, {0, 0, 1})},
                 4);
  const VisibilityBits bits = trace(sheet, {light}, gbuffer);
  EXPECT_EQ(bits.words, (std::vector<std::uint32_t>{1, 0, 0, 0}));
}

// The mean normal of a cluster that bends over a sphere's top may lean away from the point that represents
// it.
TEST(Raytraced, ACurvedClusterIsSeenFromItsPoint) {
  scene::Scene scene = room();
  add_sphere(scene, {0, 0, 0.5}, 0.25, 128);
  auto light = make_light({0.25, 0, 0.5}, {0, 0, 1});
  light.incident = {1, 0, 0};
  light.normal_deficit = 0.5f;
  const GBuffer gbuffer = gbuffer_of({pixel_at({1, 0, 0.3}, {-1, 0, 0}), pixel_at({-1, 0, 1}, {1, 0, 0})}, 2);
  const VisibilityBits bits = trace(scene, {light}, gbuffer);
  EXPECT_TRUE(bits.visible(0, 0));   // below the mean normal's horizon
  EXPECT_FALSE(bits.visible(0, 1));  // above it, but behind the sphere
}

TEST(Raytraced, LightsWithoutPowerAreSkippedAndSaidSo) {
  auto dark = make_light({0.2, 0, 0}, {0, 0, 1});
  dark.power_diffuse = {};
  const std::vector<interop::Light> lights = {make_light({0, 0, 0}, {0, 0, 1}), dark};
  GBuffer gbuffer = ceiling(2);
  gbuffer.pixels[3].id = interop::NO_INSTANCE;
  Report skipped, all;
  EXPECT_EQ(trace(room(), lights, gbuffer, skipped).words, (std::vector<std::uint32_t>{1, 1, 1, 0}));
  EXPECT_EQ(trace(room(), lights, gbuffer, all, false).words, (std::vector<std::uint32_t>{3, 3, 3, 0}));
  EXPECT_EQ(skipped.to_json()["counts"]["rays"], 3);
  EXPECT_EQ(skipped.to_json()["skipped"].size(), 2u);  // the light and the background
  EXPECT_EQ(all.to_json()["counts"]["rays"], 6);
  EXPECT_EQ(all.to_json()["counts"]["visible_fraction"], 1);
}

TEST(Raytraced, NoLightsGiveNoWords) {
  const VisibilityBits bits = trace(room(), {}, ceiling(4));
  EXPECT_EQ(bits.lights, 0);
  EXPECT_EQ(bits.width, 4);
  EXPECT_TRUE(bits.words.empty());
}

TEST(Raytraced, NeedsAGBufferOfTheSameScene) {
  const scene::Scene scene = room();
  const Lights lights = make_lights(scene, {make_light({0, 0, 0}, {0, 0, 1})});
  const auto run = [&](const GBuffer* gbuffer) {
    Report report;
    build_visibility({scene, lights, gbuffer}, {.method = "raytraced"}, nullptr, report);
  };
  expect_error(ErrorCode::missing_option, {"gbuffer", "raytraced", "--gbuffer"}, [&] { run(nullptr); });
  GBuffer elsewhere = ceiling(2);
  elsewhere.anchor = {1, 0, 0};
  expect_error(ErrorCode::invalid_data, {"gbuffer", "anchor"}, [&] { run(&elsewhere); });
}

}  // namespace
}  // namespace vsgl
