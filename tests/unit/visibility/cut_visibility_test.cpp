// Cuts of light trees with visibility: against exact bits of the same entries.

#include <gtest/gtest.h>
#include <omp.h>

#include <bit>

#include "../expect_error.h"
#include "gpu/device.h"
#include "lit_room.h"
#include "stages/visibility/map_sight.h"
#include "stages/visibility/ray_sight.h"
#include "stages/visibility/visibility.h"

namespace vsgl {
namespace {

using namespace vsgl::test;

const scene::Scene& furnished() {
  static const scene::Scene scene = furnished_room();
  return scene;
}
const GBuffer& view() {
  static const GBuffer gbuffer = look_into(furnished(), 72, 40);  // tiles cut off at both edges
  return gbuffer;
}
const Lights& tree() {
  static const Lights lights = lit_floor(furnished(), 5);
  return lights;
}

Cut find(const VisibilityParams& params, const Cut* given = nullptr, gpu::Device* device = nullptr) {
  Report report;
  return std::get<Cut>(build_visibility({furnished(), tree(), &view(), given}, params, device, report));
}

// Calls visit(light, pixel, bit) for every entry and pixel of its tile.
template <class Visit>
void for_each_bit(const Cut& cut, Visit visit) {
  for (std::size_t tile = 0; tile < cut.tiles.size(); ++tile)
    for (std::uint32_t i = 0; i < cut.tiles[tile].count; ++i)
      for (int bit = 0; bit < 256; ++bit) {
        const int x = static_cast<int>(tile) % cut.columns() * 16 + bit % 16,
                  y = static_cast<int>(tile) / cut.columns() * 16 + bit / 16;
        if (x >= cut.width || y >= cut.height) continue;
        const std::size_t entry = cut.tiles[tile].first + i;
        const std::uint32_t word =
            cut.mask_words[8 * cut.masks[entry] + static_cast<std::uint32_t>(bit / 32)];
        visit(cut.nodes[entry], static_cast<std::size_t>(y * cut.width + x), (word >> (bit % 32) & 1U) != 0);
      }
}

// What a pixel gets from a node if nothing is in between.
double unshadowed(std::uint32_t node, std::size_t pixel) {
  const auto& light = tree().lights[node];
  const auto& receiver = view().pixels[pixel];
  const Vec3 v = widen(receiver.position) - widen(light.position);
  const double d2 = dot(v, v);
  return static_cast<double>(light.power_diffuse.x) * std::max(dot(v, widen(light.normal)), 0.0) *
         std::max(-dot(v, widen(receiver.normal)), 0.0) / (d2 * d2);
}

struct Judgement {
  double wrong = 0, hidden = 0, all = 0, mean = 0;  // light: in wrong bits, of hidden pairs, of all; arriving
};

// Bits against rays, each pair weighted by its light. Without those whose representative point does not face
// the pixel: other points of the node may.
Judgement judge(const Cut& cut) {
  const trace::Tracer tracer(furnished());
  Judgement sum;
  for_each_bit(cut, [&](std::uint32_t node, std::size_t pixel, bool bit) {
    const double light = unshadowed(node, pixel);
    const auto& a = tree().lights[node];
    const auto& b = view().pixels[pixel];
    const Vec3 v = widen(b.position) - widen(a.origin);
    if (light == 0 || dot(v, widen(b.normal)) > -0.01 || dot(v, widen(a.normal)) < 0.01) return;
    const bool hidden = tracer.occluded(widen(a.origin), widen(a.normal), widen(b.position), widen(b.normal));
    sum.all += light;
    sum.hidden += hidden ? light : 0;
    sum.wrong += bit == hidden ? light : 0;
    sum.mean += bit ? light : 0;
  });
  return sum;
}

TEST(CutVisibility, ExactBitsAreWhatTheTracerSays) {
  const Judgement exact = judge(find({.method = "rays", .error = 0.05, .exact = true}));
  EXPECT_GT(exact.hidden, 0.05 * exact.all);
  EXPECT_LT(exact.wrong, 1e-4 * exact.all);  // rounding at grazing rays
}

TEST(CutVisibility, AdaptiveBitsAreNearlyExact) {
  const Judgement fine = judge(find({.method = "rays", .error = 0.005}));
  const Judgement coarse = judge(find({.method = "rays", .error = 0.05}));
  EXPECT_LT(fine.wrong, 0.005 * fine.all);      // 0.0034 seen
  EXPECT_LT(coarse.wrong, 0.013 * coarse.all);  // 0.0090 seen
  EXPECT_GT(coarse.hidden, 0.1 * coarse.all);
}

TEST(CutVisibility, TakesFewerRaysThanPairs) {
  Report adaptive, exact;
  build_visibility({furnished(), tree(), &view()}, {.method = "rays"}, nullptr, adaptive);
  build_visibility({furnished(), tree(), &view()}, {.method = "rays", .exact = true}, nullptr, exact);
  const auto rays = [](const Report& r) { return r.to_json()["counts"]["rays"].get<double>(); };
  EXPECT_LT(rays(adaptive), 0.6 * rays(exact));
}

TEST(CutVisibility, KeepsTheEntriesOfAGivenCut) {
  const Cut chosen = find({.method = "rays", .exact = true});
  Cut bare = chosen;
  bare.masks.clear();
  bare.mask_words.clear();
  const Cut again = find({.method = "rays", .exact = true}, &bare);
  EXPECT_EQ(again.nodes, chosen.nodes);
  EXPECT_EQ(again.masks, chosen.masks);
  EXPECT_EQ(again.mask_words, chosen.mask_words);
}

TEST(CutVisibility, IsTheSameOnAnyThreadCount) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Cut one = find({.method = "rays"});
  omp_set_num_threads(2);
  const Cut two = find({.method = "rays"});
  omp_set_num_threads(before);
  EXPECT_EQ(one.nodes, two.nodes);
  EXPECT_EQ(one.masks, two.masks);
  EXPECT_EQ(one.mask_words, two.mask_words);
}

// A bit costs nothing where no pixel of a tile sees a surface.
TEST(CutVisibility, BackgroundNeedsNothing) {
  GBuffer gbuffer = view();
  for (auto& pixel : gbuffer.pixels) pixel.id = interop::NO_INSTANCE;
  gbuffer.pixels[5 * 72 + 20].id = 0;  // the only pixel of tile 1
  Report report;
  const auto found = build_visibility({furnished(), tree(), &gbuffer}, {.method = "rays"}, nullptr, report);
  const Cut& cut = std::get<Cut>(found);
  for (std::size_t tile = 0; tile < cut.tiles.size(); ++tile) EXPECT_EQ(cut.tiles[tile].count > 0, tile == 1);
  EXPECT_EQ(cut.mask_words, std::vector<std::uint32_t>(8, ~0U));
}

// Maps are coarser, but neither darken nor brighten the whole.
TEST(CutVisibility, MapsComeNear) {
  gpu::Device device({.compute_only = true});
  const VisibilityParams params{.method = "maps", .level = 4};
  const Judgement maps = judge(find(params, nullptr, &device));
  EXPECT_LT(maps.wrong, 0.5 * maps.hidden);
  EXPECT_NEAR(maps.mean / (maps.all - maps.hidden), 1, 0.05);
}

TEST(CutVisibility, DeepAndShallowNodesFindTheirMaps) {
  const auto nodes = level_nodes(tree().lights, tree().levels, 2);
  ASSERT_EQ(nodes.size(), 16u);
  ShadowMaps maps;  // only the map of level 2's node 0 has an obstacle, everywhere
  maps.tile = 8;
  maps.columns = 16;
  maps.inverse_distance.assign(16 * 8 * 8, 0);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) maps.inverse_distance[static_cast<std::size_t>(y * 128 + x)] = 100;
  for (const std::uint32_t node : nodes) maps.views.push_back({tree().lights[node].origin, {0, 0, 1}});
  std::vector<interop::vec3> normals(tree().lights.size(), interop::vec3{0, 0, 1});
  const GBuffer above = gbuffer_of({pixel_at({0, 0, 2}, {0, 0, -1})}, 1);
  const visibility::MapSight sight(above, tree(), normals, maps, nodes);
  const auto sees = [&](std::uint32_t node) {
    const visibility::Pair pair{node, 0};
    return sight.see(std::span(&pair, 1)).visible != 0;
  };
  const auto& first = tree().levels;
  EXPECT_FALSE(sees(first[2]));
  EXPECT_FALSE(sees(first[3] + 3));   // below node 0
  EXPECT_FALSE(sees(first[5] + 63));  // deep below it
  EXPECT_TRUE(sees(first[2] + 1));
  EXPECT_TRUE(sees(first[5] + 64));
  EXPECT_TRUE(sees(first[1]));  // one of two maps
  EXPECT_TRUE(sees(0));
}

TEST(Sight, FacingIsDecidedByThePointsOfTheNode) {
  // A ball's top: the mean faces up, a part of the cluster faces sideways.
  std::vector<interop::Light> leaves;
  for (const Vec3 n : {Vec3{0, 0, 1}, Vec3{0.8, 0, 0.6}, Vec3{-0.8, 0, 0.6}, Vec3{0, 0.8, 0.6}})
    leaves.push_back(make_light(0.2 * n, n));
  const Lights ball = make_tree(furnished(), leaves);
  std::vector<interop::vec3> normals;
  for (const auto& light : ball.lights) normals.push_back(light.normal);
  normals[0] = {0, 0, 1};
  const scene::Scene empty = room();
  const trace::Tracer tracer(empty);
  const GBuffer gbuffer =
      gbuffer_of({pixel_at({0.9, 0, 0.15}, {-1, 0, 0}), pixel_at({0, -0.9, -1}, {0, 1, 0}),
                  pixel_at({0.9, 0, 0.15}, {1, 0, 0}), pixel_at({0, 0, 1}, {0, 0, -1})},
                 4);
  const visibility::RaySight sight(gbuffer, ball, normals, tracer);
  const std::array<visibility::Pair, 4> pairs{{{0, 0}, {0, 1}, {0, 2}, {0, 3}}};
  EXPECT_EQ(sight.facing(pairs), 0b1001U);  // by a child; none; pixel turned away; by itself
  EXPECT_EQ(sight.see(pairs).visible, 0b1001U);
}

// The receiver's own plane does not light it.
TEST(Sight, ANodeInThePixelsPlaneDoesNotFaceIt) {
  const Lights floor = lit_floor(room(), 2);
  const std::vector<interop::vec3> normals(floor.lights.size(), interop::vec3{0, 0, 1});
  const scene::Scene empty = room();
  const trace::Tracer tracer(empty);
  const GBuffer gbuffer = gbuffer_of({pixel_at({0.3, 0.1, 0}, {0, 0, 1})}, 1);
  const visibility::RaySight sight(gbuffer, floor, normals, tracer);
  for (std::uint32_t node = 0; node < floor.lights.size(); ++node) {
    const visibility::Pair pair{node, 0};
    EXPECT_EQ(sight.facing(std::span(&pair, 1)), 0u) << node;
  }
}

TEST(VisibilityChoice, AutoFollowsTheLights) {
  const Lights list = make_lights(furnished(), {make_light({0, 0, 0}, {0, 0, 1})});
  EXPECT_EQ(choose_visibility({furnished(), list}, {}).method.name, "ism");
  EXPECT_EQ(choose_visibility({furnished(), tree()}, {}).method.name, "rays");
  EXPECT_EQ(choose_visibility({furnished(), tree()}, {.method = "maps"}).method.name, "maps");
  Report report;
  build_visibility({furnished(), tree(), &view()}, {}, nullptr, report);
  EXPECT_EQ(report.to_json()["counts"]["visibility_method"], "rays");
  EXPECT_NE(report.to_json()["counts"]["visibility_reason"].get<std::string>().find("tree"),
            std::string::npos);
}

TEST(VisibilityChoice, RefusesWhatDoesNotFit) {
  const auto run = [](const VisibilityInputs& inputs, const VisibilityParams& params) {
    Report report;
    build_visibility(inputs, params, nullptr, report);
  };
  const Lights list = make_lights(furnished(), {make_light({0, 0, 0}, {0, 0, 1})});
  const Cut cut = find({.method = "rays"});
  expect_error(ErrorCode::bad_value, {"raytraced", "tree"}, [&] {
    run({furnished(), tree(), &view()}, {.method = "raytraced"});
  });
  expect_error(ErrorCode::bad_value, {"rays", "list"}, [&] {
    run({furnished(), list, &view()}, {.method = "rays"});
  });
  expect_error(ErrorCode::missing_option, {"gbuffer", "rays"}, [&] { run({furnished(), tree()}, {}); });
  expect_error(ErrorCode::conflicting_options, {"cut", "ism"}, [&] {
    run({furnished(), list, &view(), &cut}, {});
  });
  expect_error(ErrorCode::out_of_range, {"error"}, [&] {
    run({furnished(), tree(), &view()}, {.error = 2});
  });
  Cut other = cut;
  other.lights = 7;
  expect_error(ErrorCode::wrong_size, {"cut", "tree"}, [&] {
    run({furnished(), tree(), &view(), &other}, {});
  });
  other = cut;
  other.anchor = {1, 0, 0};
  expect_error(ErrorCode::invalid_data, {"cut", "anchor"}, [&] {
    run({furnished(), tree(), &view(), &other}, {});
  });
  gpu::Device device({.compute_only = true});
  Report report;
  expect_error(ErrorCode::out_of_range, {"level", "-1..5"}, [&] {
    build_visibility({furnished(), tree(), &view()}, {.method = "maps", .level = 6}, &device, report);
  });
}

}  // namespace
}  // namespace vsgl
