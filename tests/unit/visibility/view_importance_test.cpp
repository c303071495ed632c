// Where points are wanted: near the paths of light.

#include "stages/visibility/view_importance.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numeric>

#include "math/interop_vec.h"
#include "room.h"
#include "stages/visibility/points.h"

namespace vsgl::visibility {
namespace {

using namespace vsgl::test;

// A light on the floor and, unless it is background, a pixel on the ceiling above it.
struct Pair {
  scene::Scene scene = room();
  Lights lights = make_lights(scene, {make_light({0, 0, 0}, {0, 0, 1})});
  GBuffer gbuffer;

  explicit Pair(Vec3 normal = {0, 0, -1}) {
    gbuffer.width = gbuffer.height = 1;
    interop::Surface s;
    s.position = {0, 0, 2};
    s.normal = s.shading_normal = to_float(normal);
    s.diffuse = {0.5f, 0.5f, 0.5f};
    s.id = 0;
    gbuffer.pixels = {s};
  }
};

// Nearness 4 t (1 - t) / (1 + (r / 0.05 L)^2)^2 to the segment, over its mean by area; L = 2.
TEST(ViewImportance, FallsOffFromTheSegment) {
  const Pair pair;
  const std::vector<Vec3> centres = {{0, 0, 1}, {0.1, 0, 1}, {0, 0.3, 0.5}, {0, 0, 2.1}, {0, 0, -0.1}};
  const std::vector<double> areas = {1, 2, 3, 4, 5}, near = {1, 0.25, 0.0075, 0, 0};
  const auto found = view_importance(centres, areas, pair.lights, pair.gbuffer, 0);
  EXPECT_EQ(found.pairs, 256u);
  const double mean = std::inner_product(areas.begin(), areas.end(), near.begin(), 0.0) / 15;
  for (std::size_t i = 0; i < centres.size(); ++i)
    EXPECT_NEAR(found.weights[i], areas[i] * (0.5 + 0.5 * near[i] / mean), 1e-5) << i;
  EXPECT_NEAR(std::accumulate(found.weights.begin(), found.weights.end(), 0.0), 15, 1e-5);
}

// Light goes where it is strong and things are bright: the dim light's and the black pixel's paths count
// less.
TEST(ViewImportance, FollowsPowerAndReflectance) {
  Pair pair;
  pair.lights.lights.push_back(make_light({0.8, 0, 0}, {0, 0, 1}));
  pair.lights.lights.back().power_diffuse = {1e-3f, 1e-3f, 1e-3f};
  pair.gbuffer.width = 2;
  pair.gbuffer.pixels.push_back(pair.gbuffer.pixels[0]);
  pair.gbuffer.pixels[1].position.x = -0.8f;
  pair.gbuffer.pixels[1].diffuse = {0, 0, 0};
  const auto found =
      view_importance({{0, 0, 1}, {0.4, 0, 1}, {-0.4, 0, 1}}, {1, 1, 1}, pair.lights, pair.gbuffer, 0);
  EXPECT_GT(found.weights[0], 1.9);
  EXPECT_LT(found.weights[1], 0.6);
  EXPECT_LT(found.weights[2], 0.6);
}

// Where no light may reach a pixel, points are those of a pool by area, to the byte.
TEST(ViewImportance, WithoutPathsIsTheArea) {
  Pair background, turned({0, 0, 1}), dark, black;
  background.gbuffer.pixels[0].id = interop::NO_INSTANCE;
  dark.lights.lights[0].power_diffuse = {0, 0, 0};
  black.gbuffer.pixels[0].diffuse = {0, 0, 0};
  const auto patches = make_patches(room(), 0.01);
  const std::vector<double> areas = areas_of(patches);
  for (const Pair& pair : {background, turned, dark, black}) {
    const auto found = view_importance(std::vector<Vec3>(areas.size()), areas, pair.lights, pair.gbuffer, 0);
    EXPECT_EQ(found.pairs, 0u);
    const auto some = sample_points(room(), patches, found.weights, 2, 512, 1),
               all = sample_points(room(), patches, areas, 2, 512, 1);
    EXPECT_EQ(0,
              std::memcmp(some.points.data(), all.points.data(), all.points.size() * sizeof all.points[0]));
  }
}

}  // namespace
}  // namespace vsgl::visibility
