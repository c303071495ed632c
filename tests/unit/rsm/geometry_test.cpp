// Positions, normals and footprints of what a view sees.
#include <gtest/gtest.h>

#include "../expect_error.h"
#include "scenes.h"

namespace vsgl {
namespace {

using test::bake;

const interop::Surface& at(const RsmLayer& layer, int size, int x, int y) {
  return layer.surface[static_cast<std::size_t>(size * y + x)];
}

TEST(Geometry, PositionsLieOnTheTiltedPlaneAndTheRay) {
  const LightSource light = test::spot(40, 40);
  const Rsm rsm = bake(test::scene_of({test::tilted_plane(30)}, {light}), 64);
  const Vec3 normal{0.5, 0, std::cos(std::numbers::pi / 6)};
  int lit = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const interop::Surface& s = at(rsm.layers[0], 64, x, y);
      if (s.id == interop::NO_INSTANCE) continue;
      ++lit;
      const Vec3 p = to_double(s.position);
      ASSERT_NEAR(dot(p - Vec3{0, 0, -2}, normal), 0, 4e-6);
      ASSERT_NEAR(length(to_double(s.normal) - normal), 0, 1e-6);
      ASSERT_NEAR(length(to_double(s.shading_normal) - normal), 0, 1e-6);
      ASSERT_NEAR(static_cast<double>(s.depth), length(p), 1e-5);
      const Vec3 ray{light.extent_x * ((2 * x + 1) / 64.0 - 1), -light.extent_y * ((2 * y + 1) / 64.0 - 1),
                     -1};
      ASSERT_NEAR(length(cross(normalise(p), normalise(ray))), 0, 1e-5) << x << "," << y;
    }
  }
  EXPECT_NEAR(lit, std::numbers::pi * 32 * 32, 200);
}

TEST(Geometry, FootprintOfAFacingPlane) {
  const LightSource light = test::spot(40, 40);
  const Rsm rsm = bake(test::scene_of({test::tilted_plane(0)}, {light}), 64);
  const double texel = 2 * 2 * light.extent_x / 64;  // at 2 m
  const interop::Moments& m = rsm.layers[0].pyramid[64 * 32 + 32];
  EXPECT_NEAR(static_cast<double>(m.spread), 2 * texel * texel / 12, 1e-4 * texel * texel);
}

// A card of 1 m before a wall 10 m behind: no footprint reaches from the one to the other.
TEST(Geometry, FootprintsEndAtDepthDiscontinuities) {
  const LightSource light = test::spot(40, 40);
  scene::Scene scene = test::scene_of({test::quad({-0.5, -0.5, -2}, {1, 0, 0}, {0, 1, 0}),
                                       test::quad({-50, -50, -12}, {100, 0, 0}, {0, 100, 0})},
                                      {light});
  const Rsm rsm = bake(scene, 128);
  const double texel[] = {2 * 2 * light.extent_x / 128, 12 * 2 * light.extent_x / 128};
  int of_card = 0;
  for (std::size_t i = 0; i < rsm.layers[0].surface.size(); ++i) {
    const interop::Surface& s = rsm.layers[0].surface[i];
    if (s.id == interop::NO_INSTANCE) continue;
    of_card += s.id == 0;
    const double full = 2 * texel[s.id] * texel[s.id] / 12;
    ASSERT_LE(static_cast<double>(rsm.layers[0].pyramid[i].spread), full * 1.001);
  }
  EXPECT_GT(of_card, 500);
}

// One texel sees both sides of a slit: alone on its surface, it has no footprint.
TEST(Geometry, ALoneTexelHasNoFootprint) {
  LightSource light = test::spot(40, 40);
  const double texel = 2 * 2 * light.extent_x / 64;
  scene::Scene scene = test::scene_of({test::quad({0, -texel, -2}, {texel, 0, 0}, {0, texel, 0}),
                                       test::quad({-50, -50, -12}, {100, 0, 0}, {0, 100, 0})},
                                      {light});
  const Rsm rsm = bake(scene, 64);
  const std::size_t i = 64 * 32 + 32;
  ASSERT_EQ(rsm.layers[0].surface[i].id, 0u);
  EXPECT_EQ(rsm.layers[0].pyramid[i].spread, 0);
}

// Surfaces seen all but edge on, placed so that rounding to the rasteriser's grid (1/256 texel) lets them
// cover texel centres that they miss: points stay on them, between their near and far edges.
TEST(Geometry, EdgeOnSurfacesKeepTheirPoints) {
  const LightSource light = test::spot(40, 40);
  scene::Scene scene = test::scene_of({}, {light});
  constexpr int kSize = 256;
  const double texel = 2 * light.extent_x / kSize;
  for (int column = 16; column < 240; ++column) {
    const double centre = light.extent_x * ((2 * column + 1.0) / kSize - 1);
    const double step = (column % 2 == 0 ? 1 : -1) * texel / 256;
    const double near_x = centre + 0.2 * step, far_x = 2 * (centre + 0.8 * step);
    scene.instances.push_back(test::quad({near_x, -0.5, -1}, {0, 1, 0}, {far_x - near_x, 0, -1}));
  }
  const Rsm rsm = bake(scene, kSize);
  int lit = 0;
  for (std::size_t i = 0; i < rsm.layers[0].surface.size(); ++i) {
    const interop::Surface& s = rsm.layers[0].surface[i];
    if (s.id == interop::NO_INSTANCE) continue;
    ++lit;
    ASSERT_GE(s.position.z, -2.00001f);
    ASSERT_LE(s.position.z, -0.99999f);
    ASSERT_NEAR(length(to_double(s.normal)), 1, 1e-6);
    ASSERT_LT(rsm.layers[0].pyramid[i].spread, 2);
  }
  EXPECT_GT(lit, 1000);
}

TEST(Geometry, OfCoplanarDuplicatesTheFirstWins) {
  const LightSource light = test::spot(40, 40);
  const Rsm rsm = bake(test::scene_of({test::tilted_plane(30), test::tilted_plane(30)}, {light}), 64);
  for (const interop::Surface& s : rsm.layers[0].surface) {
    ASSERT_TRUE(s.id == 0 || s.id == interop::NO_INSTANCE);
  }
}

// The back of a surface, or a mirrored one of the other winding, shows the same normals.
TEST(Geometry, NormalsFaceTheViewerOnBothSides) {
  const LightSource light = test::spot(40, 40);
  scene::Instance back = test::tilted_plane(30);
  std::swap(back.indices[1], back.indices[2]);
  std::swap(back.indices[4], back.indices[5]);
  for (scene::Vertex& v : back.vertices) {
    for (float& c : v.normal) c = -c;
  }
  const Rsm front = bake(test::scene_of({test::tilted_plane(30)}, {light}), 32);
  const Rsm behind = bake(test::scene_of({back}, {light}), 32);
  for (std::size_t i = 0; i < front.layers[0].surface.size(); ++i) {
    const interop::Surface &a = front.layers[0].surface[i], &b = behind.layers[0].surface[i];
    ASSERT_NEAR(length(to_double(a.normal) - to_double(b.normal)), 0, 1e-6);
    ASSERT_NEAR(length(to_double(a.shading_normal) - to_double(b.shading_normal)), 0, 1e-6);
  }
}

TEST(Geometry, EmptySceneIsAllZero) {
  const Rsm rsm = bake(test::scene_of({}, {test::spot(40, 40)}), 16);
  for (const interop::Surface& s : rsm.layers[0].surface) {
    ASSERT_EQ(s.id, interop::NO_INSTANCE);
    ASSERT_EQ(
        length(to_double(s.position)) + length(to_double(s.normal)) + length(to_double(s.shading_normal)), 0);
    ASSERT_EQ(length(to_double(s.diffuse)) + length(to_double(s.specular)) + static_cast<double>(s.depth), 0);
  }
  for (const interop::Moments& m : rsm.layers[0].pyramid) {
    const auto* values = reinterpret_cast<const float*>(&m);
    for (std::size_t i = 0; i < sizeof(m) / sizeof(float); ++i) ASSERT_EQ(values[i], 0) << i;
  }
  const GBuffer gbuffer = test::see(test::scene_of({}, {}));
  EXPECT_EQ(gbuffer.pixels.size(), 64u * 48u);
  EXPECT_EQ(gbuffer.pixels[100].id, interop::NO_INSTANCE);
}

TEST(Geometry, NoLightIsAnErrorOfItsReflectiveShadowMap) {
  test::expect_error(ErrorCode::bad_light, {"add a light"},
                     [] { bake(test::scene_of(test::room(1), {}), 16); });
}

TEST(Geometry, CameraSeesTheSceneTheRightWayUp) {
  scene::Scene scene =
      test::scene_of({test::quad({1, 0.5, -2}, {0.5, 0, 0}, {0, 0.5, 0})}, {});  // right, above
  scene.camera.tan_x = 1;
  scene.camera.tan_y = 0.75;
  const GBuffer gbuffer = test::see(scene);
  int seen = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const interop::Surface& s = gbuffer.pixels[static_cast<std::size_t>(64 * y + x)];
      const double px = 2 * ((2 * x + 1) / 64.0 - 1), py = -1.5 * ((2 * y + 1) / 48.0 - 1);  // on z = -2
      const bool inside = px > 1 && px < 1.5 && py > 0.5 && py < 1;
      ASSERT_EQ(s.id == 0, inside) << x << "," << y;
      seen += inside;
    }
  }
  EXPECT_GT(seen, 30);
  EXPECT_EQ(gbuffer.scene_radius, 10);
}

TEST(Geometry, ResolutionKeepsTheVerticalView) {
  scene::Camera camera;
  camera.tan_x = 2;
  camera.tan_y = 1;
  const scene::Camera wide = with_resolution(camera, 300, 100);
  EXPECT_EQ(wide.tan_x, 3);
  EXPECT_EQ(wide.tan_y, 1);
  EXPECT_EQ(wide.width, 300);
  EXPECT_EQ(wide.height, 100);
}

}  // namespace
}  // namespace vsgl
