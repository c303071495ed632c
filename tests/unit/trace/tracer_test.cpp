#include "trace/tracer.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "../expect_error.h"
#include "../rsm/scenes.h"
#include "../synthetic_scene.h"

namespace vsgl::trace {
namespace {

using test::expect_error;

scene::Scene soup(int triangles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto point = [&] { return Vec3{number(random), number(random), number(random)}; };
  scene::Scene scene;
  for (int i = 0; i < triangles; ++i) {
    const Vec3 centre = point();
    test::add_triangle(scene, centre + 0.3 * point(), centre + 0.3 * point(), centre + 0.3 * point());
  }
  scene.radius = 3;
  return scene;
}

TEST(Tracer, OccludesWhatBruteForceOccludes) {
  const scene::Scene scene = soup(60);
  const Tracer tracer(scene);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> number(-1.5, 1.5);
  int hidden = 0, wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a{number(random), number(random), number(random)},
        b{number(random), number(random), number(random)};
    const bool occluded = tracer.occluded(a, {}, b, {});
    hidden += occluded;
    wrong += occluded == test::is_visible(scene, a, b);
  }
  EXPECT_GT(hidden, 4000);
  EXPECT_LT(hidden, 16000);
  EXPECT_LE(wrong, 2);  // rays through edges
}

// Single precision moves few rays across an edge.
TEST(Tracer, PacketsAreWhatSingleRaysAre) {
  const scene::Scene scene = soup(60);
  const Tracer tracer(scene);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> number(-1.5, 1.5);
  const auto point = [&] { return Vec3{number(random), number(random), number(random)}; };
  int hidden = 0, wrong = 0;
  for (int packet = 0; packet < 1000; ++packet) {
    const auto active = static_cast<std::uint32_t>(random() & 0xFFFF);
    PointPacket a, b;
    std::uint32_t expected = 0;
    for (std::uint32_t i = 0; i < PointPacket::kLanes; ++i) {
      const Vec3 from = point(), to = point(), normal_a = normalise(point()), normal_b = normalise(point());
      a.set(i, test::narrow(from), test::narrow(normal_a));
      b.set(i, test::narrow(to), test::narrow(normal_b));
      const bool occluded = tracer.occluded(from, normal_a, to, normal_b);
      expected |= static_cast<std::uint32_t>(occluded && (active >> i & 1U) != 0) << i;
    }
    hidden += std::popcount(expected);
    wrong += std::popcount(expected ^ tracer.occluded(a, b, active));
  }
  EXPECT_GT(hidden, 1500);
  EXPECT_LE(wrong, 2);
}

TEST(Tracer, FindsTheNearestSurface) {
  scene::Scene scene;
  for (const double z : {-1.0, -2.0, -4.0})
    scene.instances.push_back(test::quad({-1, -1, z}, {2, 0, 0}, {0, 2, 0}));
  scene.materials.resize(1);
  scene.radius = 5;
  const Tracer tracer(scene);
  const Vec3 direction = normalise({0.1, 0.05, -1});
  const auto first = tracer.intersect({}, direction);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->instance, 0u);
  EXPECT_NEAR(first->distance, 1 / -direction.z, 1e-6);
  EXPECT_EQ(tracer.intersect({}, direction, 1.5)->instance, 1u);
  EXPECT_EQ(tracer.intersect({}, direction, 0, &*first)->instance, 1u);
  EXPECT_FALSE(tracer.intersect({}, direction, 5));
  EXPECT_FALSE(tracer.intersect({}, -direction));
  EXPECT_TRUE(tracer.occluded_to_infinity({}, {}, direction));
  EXPECT_FALSE(tracer.occluded_to_infinity({}, {}, -direction));
  const interop::Surface s = tracer.surface(*first, -direction);
  EXPECT_NEAR(length(to_double(s.position) - first->distance * direction), 0, 1e-6);
  EXPECT_EQ(s.normal.z, 1);
}

// Points of a coarse sphere see each other through its inside and nothing through its outside, at any angle
// and size.
TEST(Tracer, SurfacesDoNotHideThemselves) {
  for (const double radius : {1.0, 300.0}) {
    scene::Scene scene;
    test::add_sphere(scene, {}, radius, 24);
    scene.radius = radius;
    const Tracer tracer(scene);
    std::mt19937 random(7);
    std::normal_distribution<double> number;
    int wrong = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 out = normalise({number(random), number(random), number(random)});
      const auto hit = tracer.intersect({}, out);
      ASSERT_TRUE(hit);
      const interop::Surface inside = tracer.surface(*hit, -out);
      const Vec3 p = to_double(inside.position), n = to_double(inside.normal);
      // Any direction away from the sphere, grazing ones too.
      const Vec3 away = normalise(Vec3{number(random), number(random), number(random)});
      const Vec3 outwards = dot(away, n) > 0 ? -away : away;
      wrong += tracer.occluded_to_infinity(p, -n, outwards);
      const auto other = tracer.intersect({}, away);
      const interop::Surface across = tracer.surface(*other, -away);
      if (dot(to_double(across.position) - p, n) < 1e-3 * radius) continue;  // of the same triangle
      wrong += tracer.occluded(p, n, to_double(across.position), to_double(across.normal));
      wrong += tracer.occluded(p, n, {}, {});
    }
    EXPECT_EQ(wrong, 0) << radius;
  }
}

TEST(Tracer, AWallThatTouchesTheFloorShadowsIt) {
  scene::Scene scene;
  test::add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  test::add_quad(scene, {0, -1, 0}, {0, 2, 0}, {0, 0, 1});
  scene.radius = 2;
  const Tracer tracer(scene);
  for (const double gap : {0.5, 0.01, 1e-3, 1e-4}) {
    EXPECT_TRUE(tracer.occluded({gap, 0, 0}, {0, 0, 1}, {-gap, 0, 1e-4}, {0, 0, 1})) << gap;
    EXPECT_FALSE(tracer.occluded({gap, 0, 0}, {0, 0, 1}, {2 * gap, 0, 0.5}, {})) << gap;
  }
}

scene::Texture noise(int width, int height, bool srgb, unsigned seed) {
  std::mt19937 random(seed);
  scene::Texture t{"noise", width, height, srgb, {}};
  for (int i = 0; i < 4 * width * height; ++i) t.rgba.push_back(static_cast<std::uint8_t>(random() >> 24));
  return t;
}

// A wavy quad with every kind of texture, repeated, in front of another that shows through its holes.
scene::Scene textured() {
  scene::Instance front = test::quad({-2, -2, -2}, {4, 0, 0.6}, {0.3, 4, 0}),
                  back = test::quad({-9, -9, -3}, {18, 0, 0}, {0, 18, 0}, 1);
  for (scene::Vertex& v : front.vertices) {
    v.uv = {3 * v.uv[0] - 1.3F, 2 * v.uv[1] - 0.4F};
    v.normal = test::to_array3(normalise({0.2 * static_cast<double>(v.position[0]), 0.1, 1}));
  }
  scene::Scene scene = test::scene_of({front, back}, {test::spot(20, 40)});
  // One normal only: rsm-bake takes differing normals for roughness.
  const scene::Texture bent{"bent", 1, 1, false, {180, 110, 243, 255}};
  scene.textures = {noise(5, 3, true, 1), noise(4, 4, false, 2), bent};
  scene::Material paint;
  paint.base_color = {0.9, 0.8, 0.7};
  paint.metallic = 0.7;
  paint.alpha = 0.8;
  paint.ndf = interop::NDF_BECKMANN;
  paint.alpha_cutoff = 0.3;
  paint.normal_scale = 0.6;
  paint.base_color_texture = 0;
  paint.metallic_roughness_texture = 1;
  paint.normal_texture = 2;
  scene.materials = {paint, test::diffuse(0.5)};
  return scene;
}

// Textures are magnified, so that rsm-bake takes their finest level too.
TEST(Tracer, SurfacesAreThoseOfTheRasteriser) {
  const scene::Scene scene = textured();
  const GBuffer seen = test::see(scene);
  const Tracer tracer(scene);
  int compared = 0, through_holes = 0, elsewhere = 0;
  for (const interop::Surface& expected : seen.pixels) {
    if (expected.id == interop::NO_INSTANCE) continue;
    const Vec3 d = normalise(to_double(expected.position) - seen.camera);
    const auto hit = tracer.intersect(seen.camera, d);
    ASSERT_TRUE(hit);
    if (hit->instance != expected.id) {
      ++elsewhere;  // at the rim of a hole
      continue;
    }
    const interop::Surface found = tracer.surface(*hit, -d);
    const auto near = [](interop::vec3 a, interop::vec3 b) {
      return length(to_double(a) - to_double(b)) < 3e-5;
    };
    EXPECT_TRUE(near(found.position, expected.position));
    EXPECT_TRUE(near(found.normal, expected.normal));
    EXPECT_TRUE(near(found.shading_normal, expected.shading_normal));
    EXPECT_TRUE(near(found.diffuse, expected.diffuse));
    EXPECT_TRUE(near(found.specular, expected.specular));
    EXPECT_NEAR(found.alpha, expected.alpha, 3e-5);
    EXPECT_NEAR(found.depth, expected.depth, 1e-5);
    EXPECT_EQ(found.ndf, expected.ndf);
    ++compared;
    through_holes += expected.id == 1;
  }
  EXPECT_GT(compared, 2000);
  EXPECT_GT(through_holes, 100);
  EXPECT_GT(compared - through_holes, 500);
  EXPECT_LE(elsewhere, 3);
}

TEST(Tracer, HolesLetShadowRaysThrough) {
  scene::Scene scene = textured();
  const GBuffer seen = test::see(scene);
  const Tracer tracer(scene);
  int hidden = 0, open = 0;
  for (const interop::Surface& pixel : seen.pixels) {
    if (pixel.id == interop::NO_INSTANCE) continue;
    const Vec3 d = normalise(to_double(pixel.position) - seen.camera);
    const Vec3 behind = seen.camera + d * (-2.95 / d.z);
    const bool occluded = tracer.occluded(seen.camera, {}, behind, {});
    (pixel.id == 1 ? open : hidden) += occluded == (pixel.id == 0);
  }
  EXPECT_GT(open, 100);
  EXPECT_GT(hidden, 500);
}

TEST(Tracer, SaysWhatIsWrong) {
  const auto fails = [](ErrorCode code, const std::string& text, auto change) {
    scene::Scene scene = textured();
    change(scene);
    expect_error(code, {text}, [&] { const Tracer tracer(scene); });
  };
  fails(ErrorCode::mesh_invalid, "no triangle", [](auto& s) { s.instances.clear(); });
  fails(ErrorCode::mesh_invalid, "vertex 99 of 4", [](auto& s) { s.instances[0].indices[3] = 99; });
  fails(ErrorCode::mesh_invalid, "material 7 of 2", [](auto& s) { s.instances[0].material = 7; });
  fails(ErrorCode::mesh_invalid, "texture 3 of 3", [](auto& s) { s.materials[0].normal_texture = 3; });
  fails(ErrorCode::texture_unreadable, "noise", [](auto& s) { s.textures[1].rgba.pop_back(); });
}

}  // namespace
}  // namespace vsgl::trace
