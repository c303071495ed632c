// Visible triangles by rays against those by drawing: the two may disagree only where a texel's centre lies
// on a silhouette.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stages/rsm/rsm.h"
#include "test_scene.h"

namespace vsgl::test {
namespace {

constexpr double kMaxShare = 0.0015;  // of texels that differ, all at edges

struct Image {
  int width, height;
  const std::vector<interop::Surface>& texels;

  const interop::Surface& at(int x, int y) const {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

bool is_same_surface(const interop::Surface& a, const interop::Surface& b) {
  return a.id == b.id && std::abs(a.depth - b.depth) <= 1e-3f * std::max(a.depth, b.depth);
}

// Whether the image has an edge within a texel of (x, y): another instance, a step in depth, or another face.
bool is_edge(const Image& image, int x, int y) {
  const interop::Surface& centre = image.at(x, y);
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, image.height - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, image.width - 1); ++i) {
      const interop::Surface& other = image.at(i, j);
      const float cosine = centre.normal.x * other.normal.x + centre.normal.y * other.normal.y +
                           centre.normal.z * other.normal.z;
      if (other.id != centre.id || cosine < 0.99f ||
          std::abs(other.depth - centre.depth) > 0.02f * centre.depth)
        return true;
    }
  return false;
}

void expect_agreement(const std::string& what, const Image& drawn, const Image& traced) {
  std::size_t different = 0, lit = 0;
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width; ++x) {
      lit += drawn.at(x, y).id != interop::NO_INSTANCE;
      if (is_same_surface(drawn.at(x, y), traced.at(x, y))) continue;
      ++different;
      EXPECT_TRUE(is_edge(drawn, x, y)) << what << " at " << x << "," << y;
    }
  EXPECT_GT(lit, drawn.texels.size() / 20) << what;
  EXPECT_LE(static_cast<double>(different), kMaxShare * static_cast<double>(drawn.texels.size())) << what;
  testing::Test::RecordProperty(what,
                                std::to_string(different) + " of " + std::to_string(drawn.texels.size()));
}

void expect_same_triangles(const std::string& name, const scene::Scene& scene) {
  gpu::Device device({});
  Report report;
  Baker drawing(scene, device, report, VisibleBy::raster), tracing(scene, device, report, VisibleBy::rays);
  const GBuffer drawn = drawing.gbuffer(), traced = tracing.gbuffer();
  expect_agreement(name + " image", {drawn.width, drawn.height, drawn.pixels},
                   {traced.width, traced.height, traced.pixels});
  const RsmParams params{128, 96};
  const Rsm drawn_rsm = drawing.rsm(params), traced_rsm = tracing.rsm(params);
  for (std::size_t i = 0; i < drawn_rsm.layers.size(); ++i)
    expect_agreement(name + " " + drawn_rsm.layers[i].name,
                     {drawn_rsm.size, drawn_rsm.size, drawn_rsm.layers[i].surface},
                     {traced_rsm.size, traced_rsm.size, traced_rsm.layers[i].surface});
}

TEST(Visible, RaysSeeWhatIsDrawn) {
  for (const char* name : {"cornell-glossy", "caustic-ring", "atrium", "thin-walls"})
    expect_same_triangles(name, test_scene(name, 160, 90));
}

TEST(Visible, EveryKindOfLightIsTracedAsItIsDrawn) {
  scene::Scene scene = test_scene("cornell-glossy", 64, 64);
  LightSource sun = scene.lights.front(), lamp = sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  lamp.name = "lamp";
  lamp.type = LightType::point;
  lamp.position = {};  // amid the box
  scene.lights.insert(scene.lights.end(), {sun, lamp});
  expect_same_triangles("lights", scene);
}

TEST(Visible, NothingIsSeenInAnEmptyScene) {
  scene::Scene empty;
  empty.camera.width = empty.camera.height = 8;
  gpu::Device device({});
  Report report;
  for (const interop::Surface& s : Baker(empty, device, report, VisibleBy::rays).gbuffer().pixels)
    EXPECT_EQ(s.id, interop::NO_INSTANCE);
}

}  // namespace
}  // namespace vsgl::test
