// Triangles cut into the cells of method tessellated.

#include "stages/visibility/cells.h"

#include <gtest/gtest.h>

#include "../expect_error.h"
#include "../synthetic_scene.h"

namespace vsgl::visibility {
namespace {

using namespace vsgl::test;

double disk_area(const interop::CellTriangle& triangle) {
  return std::numbers::pi * static_cast<double>(triangle.radius) * static_cast<double>(triangle.radius);
}
double cell_count(const interop::CellTriangle& t) {
  return std::pow(static_cast<double>(t.outer_side) * t.inner_side, 2);
}

// A quad of many points and one of 0.02 triangles a point.
scene::Scene coarse_and_fine() {
  scene::Scene scene;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) add_quad(scene, {0.05 * x, 0.05 * y, 1}, {0.05, 0, 0}, {0, 0.05, 0});
  add_quad(scene, {0, 0, 0}, {3, 0, 0}, {0, 3, 0});
  return scene;
}

TEST(Cells, DisksOfALightCoverTheAreaOnce) {
  for (const int points : {1, 10, 400, 5000}) {
    const Cells cells = make_cells(coarse_and_fine(), points);
    double area = 0;
    for (const auto& t : cells.triangles) area += cell_count(t) / interop::CELLS_PER_POINT * disk_area(t);
    EXPECT_NEAR(area, 10, 1e-4) << points;
    EXPECT_NEAR(std::numbers::pi * cells.disk_radius * cells.disk_radius * points, 10, 1e-9);
  }
}

TEST(Cells, GiveAboutAsManyPointsAsAsked) {
  for (const int points : {400, 5000, 100000}) {
    const Cells cells = make_cells(coarse_and_fine(), points);
    EXPECT_NEAR(cells.points_per_light(), points, 0.1 * points);
  }
}

// Large triangles come first, in blocks; starts are the running sum of cells.
TEST(Cells, FollowOneAnother) {
  const Cells cells = make_cells(coarse_and_fine(), 400);
  ASSERT_EQ(cells.triangles.size(), 802u);
  double sum = 0;
  for (std::size_t i = 0; i < cells.triangles.size(); ++i) {
    EXPECT_EQ(cells.starts[i], sum);
    EXPECT_EQ(cells.triangles[i].inner_side == 32 && cells.triangles[i].outer_side > 1, i < 2) << i;
    sum += cell_count(cells.triangles[i]);
  }
  EXPECT_EQ(cells.count, sum);
}

TEST(Cells, MasksHoldTheCutOuts) {
  scene::Scene scene;
  add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(make_cells(scene, 100).triangles[0].mask_width, 0u);
  scene.textures.push_back({"mask", 3, 1, false, {0, 0, 0, 255, 0, 0, 0, 127, 0, 0, 0, 128}});
  scene.materials[0].base_color_texture = 0;
  scene.materials[0].alpha_cutoff = 0.5;
  const Cells cells = make_cells(scene, 100);
  EXPECT_EQ(cells.masks, (std::vector<std::uint32_t>{0b101}));
  EXPECT_EQ(cells.triangles[1].mask_width, 3u);
  EXPECT_EQ(cells.triangles[1].mask_height, 1u);
}

TEST(Cells, NeedASurfaceAndFitIntoAWord) {
  scene::Scene scene;
  add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  expect_error(ErrorCode::mesh_invalid, {"scene", "no surface"}, [&] { make_cells(scene, 100); });
  add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_NO_THROW(make_cells(scene, 1 << 20));
  expect_error(ErrorCode::out_of_range, {"points", "2^32"}, [&] { make_cells(scene, 1 << 23); });
}

}  // namespace
}  // namespace vsgl::visibility
