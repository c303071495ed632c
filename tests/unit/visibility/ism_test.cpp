#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "math/frame.h"
#include "math/octahedral.h"
#include "room.h"
#include "stages/visibility/shadow_lookup.h"
#include "stages/visibility/visibility.h"

namespace vsgl {
namespace {

using namespace vsgl::test;

gpu::Device& device() {
  static gpu::Device instance({.compute_only = true});
  return instance;
}

// What a camera might see of the room: points on all walls.
const GBuffer& view() {
  static const GBuffer gbuffer = [] {
    GBuffer out;
    out.width = 30;
    out.height = 20;
    for (int i = 0; i < 600; ++i) {
      const auto at = wall_point(room_low, room_high, (i % 6 + 0.5) / 6, (i % 25 + 0.5) / 25,
                                 std::fmod(i * 0.618034, 1.0));
      interop::Surface s;
      s.position = narrow(at.position);
      s.normal = s.shading_normal = narrow(at.normal);
      s.diffuse = {0.5f, 0.5f, 0.5f};
      s.id = 0;
      out.pixels.push_back(s);
    }
    return out;
  }();
  return gbuffer;
}

ShadowMaps shadow_maps(const scene::Scene& scene, const Lights& lights, const VisibilityParams& params,
                       gpu::Device& on, Report& report) {
  return std::get<ShadowMaps>(build_visibility({scene, lights, &view()}, params, &on, report));
}

ShadowMaps build(const scene::Scene& scene, const std::vector<interop::Light>& lights,
                 const VisibilityParams& params = {.method = "ism"}) {
  Report report;
  return shadow_maps(scene, make_lights(scene, lights), params, device(), report);
}

// A disk halfway between the floor and the ceiling.
scene::Scene room_with_disk() {
  scene::Scene scene = room();
  add_disk(scene, {0.1, 0.05, 1}, 0.35);
  return scene;
}

scene::Scene room_with_boxes() {
  scene::Scene scene = room();
  add_box(scene, {-0.7, -0.6, 0}, {-0.2, 0, 0.6});
  add_box(scene, {0.2, 0.1, 0}, {0.7, 0.6, 1.1});
  return scene;
}

// Lights spread over the walls, but for the floor under the boxes.
std::vector<interop::Light> wall_lights(int n, double variance) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  std::vector<interop::Light> lights;
  for (int i = 0; static_cast<int>(lights.size()) < n; ++i) {
    const double wall = (i % 6 + 0.5) / 6, s = unit(random), t = unit(random);
    const auto at = wall_point(room_low, room_high, wall, s, t);
    const Vec3 p = at.position;
    const bool covered = p.z == 0 && ((std::abs(p.x + 0.45) < 0.3 && std::abs(p.y + 0.3) < 0.35) ||
                                      (std::abs(p.x - 0.45) < 0.3 && std::abs(p.y - 0.35) < 0.3));
    if (!covered) lights.push_back(make_light(at.position, at.normal, variance));
  }
  return lights;
}

struct Overlap {
  int mapped = 0, exact = 0, both = 0;
  double iou() const { return static_cast<double>(both) / (mapped + exact - both); }
  double area_ratio() const { return static_cast<double>(mapped) / exact; }
};

// The shadow on the ceiling of light 0, on a grid of 96^2 receivers: in the map and by exact rays.
Overlap ceiling_shadow(const scene::Scene& scene, const ShadowMaps& maps, Vec3 light) {
  Overlap overlap;
  for (int j = 0; j < 96; ++j)
    for (int i = 0; i < 96; ++i) {
      const Vec3 receiver{-1 + 2 * (i + 0.5) / 96, -1 + 2 * (j + 0.5) / 96, 2};
      const bool mapped = shadow_visibility(maps, 0, receiver, {0, 0, -1}) < 0.5;
      const bool exact = !is_visible(scene, light, receiver);
      overlap.mapped += mapped;
      overlap.exact += exact;
      overlap.both += mapped && exact;
    }
  return overlap;
}

// A way to choose the points, and how well it does: of the disk's shadow the least overlap and the largest
// area ratio, and the largest error of a light's visibility.
struct Way {
  const char* method;
  double iou, area_ratio, worst_light;
};

class IsmPoints : public testing::TestWithParam<Way> {
 protected:
  VisibilityParams params_{.method = GetParam().method};
};
// Pull-push closes gaps as wide as equal disks leave: with denser points shadows are fat. The disk is a fan
// of thin triangles, whose cells are thin, too.
INSTANTIATE_TEST_SUITE_P(From, IsmPoints,
                         testing::Values(Way{"ism", 0.85, 1.1, 0.1}, Way{"aism", 0.85, 1.15, 0.1},
                                         Way{"tessellated", 0.75, 1.1, 0.11}),
                         [](const auto& test) { return std::string(test.param.method); });

TEST_P(IsmPoints, DiskCastsTheShadowThatRaysFind) {
  const auto scene = room_with_disk();
  for (const Vec3 position : {Vec3{0, 0, 0}, Vec3{-0.4, 0.3, 0}, Vec3{0.5, -0.6, 0}}) {
    const auto maps = build(scene, {make_light(position, {0, 0, 1})}, params_);
    const auto overlap = ceiling_shadow(scene, maps, position);
    EXPECT_GT(overlap.exact, 500);
    EXPECT_GT(overlap.iou(), GetParam().iou);
    EXPECT_GT(overlap.area_ratio(), 0.9);
    EXPECT_LT(overlap.area_ratio(), GetParam().area_ratio);
    RecordProperty("iou", std::to_string(overlap.iou()));
    RecordProperty("area_ratio", std::to_string(overlap.area_ratio()));
  }
}

// Of a triangle of many points each gets a cell of its own. (By ism the overlap is 0.74.)
TEST(Ism, TessellatedSquareCastsTheShadowThatRaysFind) {
  scene::Scene scene = room();
  add_quad(scene, {-0.25, -0.2, 1}, {0.6, 0, 0}, {0, 0.6, 0});
  const auto maps = build(scene, {make_light({0, 0, 0}, {0, 0, 1})}, {.method = "tessellated"});
  const auto overlap = ceiling_shadow(scene, maps, {0, 0, 0});
  EXPECT_GT(overlap.exact, 500);
  EXPECT_GT(overlap.iou(), 0.85);
  EXPECT_GT(overlap.area_ratio(), 0.9);
  EXPECT_LT(overlap.area_ratio(), 1.1);
}

TEST_P(IsmPoints, NothingAboveTheLightMeansNoShadow) {
  scene::Scene scene;
  scene.radius = 2;
  add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  const auto maps =
      build(scene, {make_light({0, 0, 0}, {0, 0, 1}), make_light({0.5, 0.2, 0}, {0, 0, 1}, 0.01)}, params_);
  for (const float inverse : maps.inverse_distance) ASSERT_EQ(inverse, 0.0f);
  for (int i = 0; i < 100; ++i) {
    const Vec3 receiver{std::sin(i), std::cos(3 * i), 0.1 + 0.02 * i};
    EXPECT_DOUBLE_EQ(shadow_visibility(maps, i % 2, receiver, {0, 0, -1}), 1);
  }
}

// A screen over the light, opaque where x < 0.
TEST_P(IsmPoints, CutOutsCastNothing) {
  scene::Scene scene;
  scene.radius = 2;
  add_quad(scene, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
  scene.textures.push_back({"mask", 2, 1, false, {255, 255, 255, 255, 255, 255, 255, 0}});
  scene.materials[0].base_color_texture = 0;
  scene.materials[0].alpha_cutoff = 0.5;
  const auto maps = build(scene, {make_light({0, 0, 0}, {0, 0, 1})}, params_);
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 16; ++i) {
      const Vec3 receiver{0.7 + 0.05 * i, -1.2 + 0.16 * j, 2};
      EXPECT_GT(shadow_visibility(maps, 0, receiver, {0, 0, -1}), 0.99) << i << ',' << j;
      EXPECT_LT(shadow_visibility(maps, 0, {-receiver.x, receiver.y, 2}, {0, 0, -1}), 0.01) << i << ',' << j;
    }
}

TEST(Ism, BehindTheEmittingSurfaceNothingIsLit) {
  const auto maps = build(room(), {make_light({0, 0, 1}, {0, 0, 1})});
  EXPECT_EQ(shadow_visibility(maps, 0, {0.2, 0.1, 0.5}, {0, 0, 1}), 0);
  EXPECT_EQ(shadow_visibility(maps, 0, {0.2, 0.1, 2}, {0, 0, -1}), 1);
}

// A flat surface does not light itself, and lights the floor right up to the edge that they share.
TEST(Ism, ConcaveEdgesHaveNoSeams) {
  for (const double height : {0.1, 0.3, 0.8}) {
    const auto maps = build(room(), {make_light({-1, 0.1, height}, {1, 0, 0}, 0.01 * height * height)});
    for (const double x : {0.002, 0.01, 0.05, 0.2}) {
      double lit = 0;
      for (int i = 0; i < 40; ++i) {
        const double y = -0.9 + 0.045 * i;
        EXPECT_EQ(shadow_visibility(maps, 0, {-1, y, x}, {1, 0, 0}), 0);
        lit += shadow_visibility(maps, 0, {-1 + x, y, 0}, {0, 0, 1}) / 40;
      }
      EXPECT_GT(lit, 0.9) << "light at " << height << ", " << x << " from the edge";
    }
  }
}

TEST_P(IsmPoints, ConvexRoomShadowsNothing) {
  const auto lights = wall_lights(48, 1e-3);
  const auto maps = build(room(), lights, params_);
  double lit = 0;
  int pairs = 0;
  for (std::size_t light = 0; light < lights.size(); ++light)
    for (int i = 0; i < 600; ++i) {
      const auto at = wall_point(room_low, room_high, (i % 6 + 0.5) / 6, (i % 25 + 0.5) / 25,
                                 std::fmod(i * 0.618034, 1.0));
      if (dot(widen(lights[light].origin) - at.position, at.normal) <= 0.05)
        continue;  // the light's own wall
      lit += shadow_visibility(maps, light, at.position, at.normal) >= 0.5;
      ++pairs;
    }
  EXPECT_GT(pairs, 20000);
  EXPECT_GT(lit / pairs, 0.995);
  RecordProperty("lit", std::to_string(lit / pairs));
}

// Mean |V - V_ray| of the worst light and of all, and the number of hidden pairs.
struct VisibilityError {
  double worst_light = 0, mean = 0, hidden = 0;
};
VisibilityError visibility_error(const scene::Scene& scene, const ShadowMaps& maps,
                                 const std::vector<interop::Light>& lights) {
  VisibilityError out;
  for (std::size_t light = 0; light < lights.size(); ++light) {
    double error = 0;
    int rays = 0;
    for (int i = 0; i < 384; ++i) {
      const auto at = wall_point(room_low, room_high, (i % 6 + 0.5) / 6, (i % 16 + 0.5) / 16,
                                 std::fmod(i * 0.618034, 1.0));
      const Vec3 origin = widen(lights[light].origin), to_light = origin - at.position;
      if (dot(to_light, at.normal) <= 0.05 || dot(to_light, widen(lights[light].normal)) >= -0.05) continue;
      const bool visible = is_visible(scene, origin, at.position);
      error += std::abs(shadow_visibility(maps, light, at.position, at.normal) - (visible ? 1.0 : 0.0));
      out.hidden += visible ? 0 : 1;
      ++rays;
    }
    error /= rays;
    out.worst_light = std::max(out.worst_light, error);
    out.mean += error / static_cast<double>(lights.size());
  }
  return out;
}

TEST_P(IsmPoints, VisibilityAgreesWithRays) {
  const auto scene = room_with_boxes();
  const auto lights = wall_lights(36, 1e-4);
  const auto error = visibility_error(scene, build(scene, lights, params_), lights);
  EXPECT_GT(error.hidden, 500);
  EXPECT_LT(error.mean, 0.05);
  EXPECT_LT(error.worst_light, GetParam().worst_light);
  RecordProperty("mean", std::to_string(error.mean));
  RecordProperty("worst_light", std::to_string(error.worst_light));
}

// Every texel with a splat holds the ceiling's distance: the frame, the mapping and the splats' depths all
// take part.
TEST(Ism, MapHoldsTheDistanceOfAPlane) {
  scene::Scene scene;
  scene.radius = 4;
  VisibilityParams params;
  params.pull_push = false;
  add_quad(scene, {-3, -3, 2}, {6, 0, 0}, {0, 6, 0});
  for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}, Vec3{-0.28, 0.6, 0.7493}}) {
    const auto maps = build(scene, {make_light({0.2, -0.1, 0}, normalise(normal))}, params);
    const Vec3 origin = widen(maps.views[0].origin);
    const auto frame = frame_about(widen(maps.views[0].axis));
    int seen = 0;
    for (int y = 0; y < maps.tile; ++y)
      for (int x = 0; x < maps.tile; ++x) {
        const float inverse = maps.inverse_distance[y * maps.tile + x];
        const Vec3 w = frame.to_world(
            hemi_octahedral_decode({(x + 0.5) * 2 / maps.tile - 1, (y + 0.5) * 2 / maps.tile - 1}));
        const Vec3 hit = origin + (2 - origin.z) / w.z * w;
        if (inverse == 0 || w.z < 0.3) continue;
        EXPECT_NEAR(static_cast<double>(inverse) * length(hit - origin), 1, 1e-4) << x << ',' << y;
        ++seen;
      }
    EXPECT_GT(seen, 1000);
  }
}

TEST(Ism, PullPushLeavesNoHolesInAClosedRoom) {
  VisibilityParams params;
  params.points_per_light = 2048;
  const auto lights = wall_lights(8, 1e-3);
  const auto empty_share = [](const ShadowMaps& maps) {
    const auto empty =
        std::count(maps.inverse_distance.begin(), maps.inverse_distance.begin() + 8 * 64 * 64, 0.0f);
    return static_cast<double>(empty) / (8 * 64 * 64);
  };
  params.pull_push = false;
  EXPECT_GT(empty_share(build(room(), lights, params)), 0.3);
  params.pull_push = true;
  EXPECT_LT(empty_share(build(room(), lights, params)), 0.1);
}

// Tiles of lights with power around one without: nothing may leak into it.
TEST(Ism, TilesAreApartAndPowerlessLightsAreSkipped) {
  auto lights = wall_lights(9, 1e-3);
  lights[4].power_diffuse = {0, 0, 0};
  Report report;
  const auto maps = shadow_maps(room(), make_lights(room(), lights), {}, device(), report);
  ASSERT_EQ(maps.columns, 3);
  const auto tile_sum = [](const ShadowMaps& m, int column, int row) {
    double sum = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x)
        sum += static_cast<double>(m.inverse_distance[(row * 64 + y) * 192 + column * 64 + x]);
    return sum;
  };
  for (int i = 0; i < 9; ++i) {
    if (i == 4)
      EXPECT_EQ(tile_sum(maps, 1, 1), 0);
    else
      EXPECT_GT(tile_sum(maps, i % 3, i / 3), 500) << i;
  }
  EXPECT_EQ(report.to_json()["skipped"].size(), 1u);
  VisibilityParams all;
  all.skip_powerless = false;
  EXPECT_GT(tile_sum(build(room(), lights, all), 1, 1), 500);
}

// A light's map does not depend on which other lights there are, but for its share of the points.
TEST(Ism, BatchesDoNotChangeMaps) {
  VisibilityParams params;
  params.points_per_light = 64;
  params.tile = 512;  // 64 maps a batch
  params.pull_push = false;
  const auto lights = wall_lights(66, 1e-3);
  const auto many = build(room(), lights, params);
  auto alone = lights;
  for (std::size_t i = 0; i < 65; ++i) alone[i].power_diffuse = {0, 0, 0};
  const auto one = build(room(), alone, params);
  const std::size_t width = static_cast<std::size_t>(many.columns) * 512, column = 65 % 9, row = 65 / 9;
  for (std::size_t y = row * 512; y < row * 512 + 512; ++y)
    ASSERT_EQ(0, std::memcmp(&many.inverse_distance[y * width + column * 512],
                             &one.inverse_distance[y * width + column * 512], 512 * sizeof(float)));
}

// 1024 lights at one place look at points of their own; then they come round.
TEST(Ism, TessellationGivesEachLightOtherPoints) {
  VisibilityParams params{.method = "tessellated"};
  params.points_per_light = 64;
  params.tile = 16;
  params.pull_push = false;
  const auto maps =
      build(room(), std::vector<interop::Light>(1025, make_light({0, 0, 0}, {0, 0, 1})), params);
  const auto tile = [&](int light) {
    std::vector<float> texels;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        texels.push_back(maps.inverse_distance[static_cast<std::size_t>(
            (light / maps.columns * 16 + y) * maps.columns * 16 + light % maps.columns * 16 + x)]);
    return texels;
  };
  EXPECT_EQ(tile(0), tile(1024));
  for (int light = 1; light < 1024; ++light) ASSERT_NE(tile(0), tile(light)) << light;
}

TEST_P(IsmPoints, SameBytesOnAnyThreadCountAndEveryRun) {
  const auto scene = room_with_boxes();
  const auto lights = wall_lights(40, 1e-3);
  const auto build_with = [&](int threads) {
    omp_set_num_threads(threads);
    gpu::Device own({.threads = threads, .compute_only = true});
    Report report;
    return shadow_maps(scene, make_lights(scene, lights), params_, own, report);
  };
  const auto first = build_with(1);
  for (const int threads : {2, 1, 2}) {
    const auto again = build_with(threads);
    ASSERT_EQ(first.inverse_distance.size(), again.inverse_distance.size());
    EXPECT_EQ(0, std::memcmp(first.inverse_distance.data(), again.inverse_distance.data(),
                             first.inverse_distance.size() * sizeof(float)));
  }
}

TEST(Ism, TinyMotionChangesLittle) {
  const auto scene = room_with_boxes();
  auto lights = wall_lights(24, 1e-4);
  const auto before = build(scene, lights);
  for (auto& light : lights) {
    // Along the wall.
    const Vec3 step = 1e-4 * frame_about(widen(light.normal)).x;
    light.origin = light.position = narrow(widen(light.origin) + step);
  }
  const auto after = build(scene, lights);
  double change = 0;
  for (std::size_t light = 0; light < lights.size(); ++light)
    for (int i = 0; i < 300; ++i) {
      const auto at = wall_point(room_low, room_high, (i % 6 + 0.5) / 6, (i % 16 + 0.5) / 16,
                                 std::fmod(i * 0.618034, 1.0));
      change += std::abs(shadow_visibility(before, light, at.position, at.normal) -
                         shadow_visibility(after, light, at.position, at.normal));
    }
  EXPECT_LT(change / (300.0 * static_cast<double>(lights.size())), 0.02);
}

TEST(Ism, NoLightsGiveAnEmptyAtlas) {
  const auto maps = build(room(), {});
  EXPECT_TRUE(maps.views.empty());
  EXPECT_TRUE(maps.inverse_distance.empty());
}

TEST(Ism, CurvedAndOffCentreClustersAreCounted) {
  auto lights = wall_lights(3, 1e-4);
  lights[0].normal_deficit = 0.8f;
  lights[1].position.z += 0.5f;
  Report report;
  shadow_maps(room(), make_lights(room(), lights), {}, device(), report);
  EXPECT_EQ(report.to_json()["counts"]["curved_clusters"], 1);
  EXPECT_EQ(report.to_json()["counts"]["off_centre_origins"], 1);
}

// The error that a call with these parameters ends in.
ErrorCode error_of(const VisibilityParams& params, const Lights& lights) {
  Report report;
  try {
    shadow_maps(room(), lights, params, device(), report);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "accepted";
  return ErrorCode::internal;
}

TEST(Ism, RefusesWhatIsOutOfRange) {
  const auto good = make_lights(room(), wall_lights(2, 1e-3));
  const auto with = [](auto change) {
    VisibilityParams params;
    change(params);
    return params;
  };
  EXPECT_EQ(error_of(with([](auto& p) { p.points_per_light = 0; }), good), ErrorCode::out_of_range);
  EXPECT_EQ(error_of(with([](auto& p) { p.points_per_light = (1 << 20) + 1; }), good),
            ErrorCode::out_of_range);
  EXPECT_EQ(error_of(with([](auto& p) { p.tile = 4; }), good), ErrorCode::out_of_range);
  EXPECT_EQ(error_of(with([](auto& p) { p.tile = 48; }), good), ErrorCode::out_of_range);
  EXPECT_EQ(error_of(with([](auto& p) { p.splat_scale = -1; }), good), ErrorCode::out_of_range);
  EXPECT_EQ(error_of(with([](auto& p) { p.splat_scale = std::nan(""); }), good), ErrorCode::out_of_range);
  EXPECT_EQ(error_of(with([](auto& p) { p.method = "isn"; }), good), ErrorCode::bad_value);
  const auto many = make_lights(room(), std::vector<interop::Light>(5000, good.lights[0]));
  EXPECT_EQ(error_of(with([](auto& p) { p.tile = 512; }), many), ErrorCode::out_of_range);
  auto tilted = good;
  tilted.lights[1].normal = {0, 0, 0.5f};
  EXPECT_EQ(error_of({}, tilted), ErrorCode::invalid_data);
  auto elsewhere = good;
  elsewhere.anchor = {1, 0, 0};
  EXPECT_EQ(error_of({}, elsewhere), ErrorCode::invalid_data);
}

}  // namespace
}  // namespace vsgl
