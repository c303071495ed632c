#include "stages/visibility/points.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cstring>

#include "../synthetic_scene.h"
#include "base/error.h"

namespace vsgl::visibility {
namespace {

using namespace vsgl::test;

// Two quads of very different area, and a degenerate triangle between them.
scene::Scene unequal_scene() {
  scene::Scene scene;
  add_quad(scene, {0, 0, 0}, {8, 0, 0}, {0, 8, 0});
  add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  add_quad(scene, {0, 0, 1}, {2, 0, 0}, {0, 1, 0});
  return scene;
}

PointPool sample_evenly(const scene::Scene& scene, std::size_t light_count, int points_per_light,
                        std::uint64_t seed, const std::vector<Patch>& patches) {
  return sample_points(scene, patches, areas_of(patches), light_count, points_per_light, seed);
}
PointPool sample_evenly(const scene::Scene& scene, std::size_t light_count, int points_per_light,
                        std::uint64_t seed) {
  return sample_evenly(scene, light_count, points_per_light, seed, make_patches(scene));
}

// Chi-square of the points k in [first, first + count) against an 8x8 grid of equal cells on the large quad
// and one of the small quad as a whole (65 classes).
double chi_square(const PointPool& pool, std::size_t first, std::size_t count) {
  std::array<double, 65> seen{};
  for (std::size_t k = first; k < first + count; ++k) {
    const auto& p = pool.points[k].position;
    seen[p.z > 0.5f ? 64 : static_cast<int>(p.y) * 8 + static_cast<int>(p.x)] += 1;
  }
  double sum = 0;
  for (int c = 0; c < 65; ++c) {
    const double expected = static_cast<double>(count) * (c == 64 ? 2.0 : 1.0) / 66.0;
    sum += (seen[c] - expected) * (seen[c] - expected) / expected;
  }
  return sum;
}

TEST(Points, AreUniformByAreaInEveryRun) {
  const auto pool = sample_evenly(unequal_scene(), 16, 4096, 0);
  ASSERT_EQ(pool.points.size(), 16u * 4096u);
  EXPECT_NEAR(pool.area, 66, 1e-9);
  // 64 degrees of freedom: 104.7 is exceeded once in 1000 by random points; these are stratified.
  for (std::size_t light = 0; light < 16; ++light)
    EXPECT_LT(chi_square(pool, light * 4096, 4096), 104.7) << "run " << light;
  EXPECT_LT(chi_square(pool, 0, pool.points.size()), 104.7);
}

// Cutting triangles does not change the density, nor the disks.
TEST(Points, OfPatchesAreUniformByArea) {
  const auto scene = unequal_scene();
  const auto patches = make_patches(scene, 0.1);
  EXPECT_GT(patches.size(), 660u);
  EXPECT_LT(patches.size(), 900u);
  const auto pool = sample_evenly(scene, 4, 4096, 0, patches);
  EXPECT_NEAR(pool.area, 66, 1e-9);
  for (std::size_t light = 0; light < 4; ++light) EXPECT_LT(chi_square(pool, light * 4096, 4096), 104.7);
  for (const auto& point : pool.points) EXPECT_FLOAT_EQ(point.radius, static_cast<float>(pool.disk_radius));
}

// Four times the weight on the small quad: as many more points, of half the radius. All area is covered once.
TEST(Points, FollowTheWeights) {
  const auto scene = unequal_scene();
  const auto patches = make_patches(scene, 0.5);
  std::vector<double> weights = areas_of(patches);
  const auto is_small = [&](const Patch& p) { return p.first_index >= 9; };
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (is_small(patches[i])) weights[i] *= 4;
  const auto pool = sample_points(scene, patches, weights, 1, 20000, 0);
  double small = 0, area = 0;
  for (const auto& point : pool.points) {
    const double radius = static_cast<double>(point.radius);
    small += point.position.z > 0.5f;
    area += std::numbers::pi * radius * radius;
    EXPECT_NEAR(radius / pool.disk_radius, std::sqrt(72.0 / 66) * (point.position.z > 0.5f ? 0.5 : 1), 1e-5);
  }
  EXPECT_NEAR(small / 20000, 8.0 / 72, 1e-3);
  EXPECT_NEAR(area, 66, 0.05);
}

TEST(Points, DisksCoverTheAreaOnce) {
  const auto pool = sample_evenly(unequal_scene(), 1, 1000, 0);
  EXPECT_NEAR(1000 * std::numbers::pi * pool.disk_radius * pool.disk_radius, pool.area, 1e-9);
  for (const auto& point : pool.points) EXPECT_FLOAT_EQ(point.radius, static_cast<float>(pool.disk_radius));
}

TEST(Points, LieOnTheirTrianglesWithTheirNormals) {
  const auto pool = sample_evenly(unequal_scene(), 1, 5000, 3);
  for (const auto& point : pool.points) {
    EXPECT_TRUE(point.position.z == 0.0f || point.position.z == 1.0f);
    EXPECT_NEAR(std::abs(point.normal.z), 1, 1e-6);
  }
}

TEST(Points, SeedMovesThemInsideTheirTriangles) {
  const auto a = sample_evenly(unequal_scene(), 1, 64, 1), b = sample_evenly(unequal_scene(), 1, 64, 2);
  EXPECT_NE(0, std::memcmp(a.points.data(), b.points.data(), 64 * sizeof(a.points[0])));
  for (std::size_t k = 0; k < 64; ++k) EXPECT_EQ(a.points[k].position.z, b.points[k].position.z);
}

TEST(Points, PoolIsBoundedAndShared) {
  EXPECT_EQ(sample_evenly(unequal_scene(), 1000, 8192, 0).points.size(), max_pool_size);
}

TEST(Points, CutOutsCastNothing) {
  scene::Scene scene;
  add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  // Left half opaque, right half transparent.
  scene.textures.push_back({"mask", 2, 1, false, {255, 255, 255, 255, 255, 255, 255, 0}});
  scene.materials[0].base_color_texture = 0;
  scene.materials[0].alpha_cutoff = 0.5;
  const auto pool = sample_evenly(scene, 1, 4096, 0);
  EXPECT_NEAR(static_cast<double>(pool.holes) / 4096, 0.5, 0.02);
  for (const auto& point : pool.points)
    EXPECT_EQ(point.radius == 0.0f, point.position.x >= 0.5f) << point.position.x;
}

TEST(Points, DoNotDependOnThreads) {
  omp_set_num_threads(1);
  const auto one = sample_evenly(unequal_scene(), 8, 4096, 7);
  omp_set_num_threads(2);
  const auto two = sample_evenly(unequal_scene(), 8, 4096, 7);
  ASSERT_EQ(one.points.size(), two.points.size());
  EXPECT_EQ(0, std::memcmp(one.points.data(), two.points.data(), one.points.size() * sizeof(one.points[0])));
}

TEST(Points, NeedASurface) {
  scene::Scene scene;
  add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  try {
    sample_evenly(scene, 1, 100, 0);
    FAIL() << "a scene without area was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::mesh_invalid);
  }
}

}  // namespace
}  // namespace vsgl::visibility
