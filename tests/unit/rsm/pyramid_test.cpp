// The moment pyramid against a double-precision merge, determinism, and refused input.
#include <gtest/gtest.h>

#include <cstring>

#include "../expect_error.h"
#include "math/moments.h"
#include "scenes.h"
#include "stages/rsm/mip_chain.h"

namespace vsgl {
namespace {

using test::bake;
using test::expect_error;

scene::Scene mixed_scene() {
  scene::Scene scene = test::scene_of(test::room(2), {test::spot(20, 50)});
  scene.instances.push_back(test::quad({-0.5, -0.7, -1}, {1, 0, -0.3}, {0, 1, 0.2}, 1));
  scene::Material metal;
  metal.base_color = {0.9, 0.6, 0.3};
  metal.metallic = 0.7;
  metal.alpha = 0.05;
  scene.materials.push_back(metal);
  return scene;
}

void expect_close(Vec3 a, Vec3 b, double relative, const char* what) {
  EXPECT_LE(length(a - b), relative * length(b)) << what;
}

TEST(Pyramid, TopEqualsADoubleMerge) {
  const Rsm rsm = bake(mixed_scene(), 128);
  const std::vector<interop::Moments>& pyramid = rsm.layers[0].pyramid;
  ASSERT_EQ(pyramid.size(), pyramid_texels(128));
  std::vector<DoubleMoments> texels;
  for (std::size_t i = 0; i < 128 * 128; ++i) texels.push_back(to_double(pyramid[i]));
  const std::vector<double> shares(texels.size(), 1.0 / static_cast<double>(texels.size()));
  const DoubleMoments expected = merge_moments(texels, shares), top = to_double(pyramid.back());
  constexpr double kBound = 1e-5;
  expect_close(top.flux, expected.flux, kBound, "flux");
  expect_close(top.power_diffuse, expected.power_diffuse, kBound, "power_diffuse");
  expect_close(top.power_specular, expected.power_specular, kBound, "power_specular");
  EXPECT_NEAR(top.weight, expected.weight, kBound * expected.weight);
  expect_close(top.position, expected.position, kBound, "position");
  EXPECT_NEAR(top.spread, expected.spread, kBound * expected.spread);
  expect_close(top.diffuse_mean, expected.diffuse_mean, kBound, "diffuse_mean");
  EXPECT_NEAR(top.diffuse_deficit, expected.diffuse_deficit, kBound * expected.diffuse_deficit);
  expect_close(top.specular_mean, expected.specular_mean, kBound, "specular_mean");
  EXPECT_NEAR(top.specular_deficit, expected.specular_deficit, kBound * expected.specular_deficit);
  expect_close(top.normal_mean, expected.normal_mean, kBound, "normal_mean");
  EXPECT_NEAR(top.normal_deficit, expected.normal_deficit, kBound * expected.normal_deficit);
  EXPECT_GT(top.spread, 0.01);
  EXPECT_GT(top.specular_deficit, 1e-4);
}

TEST(Pyramid, LevelsMergeTheirOwnBlocks) {
  const Rsm rsm = bake(mixed_scene(), 32);
  const std::vector<interop::Moments>& pyramid = rsm.layers[0].pyramid;
  const std::vector<double> quarters(4, 0.25);
  for (const auto& [x, y] : std::vector<std::pair<int, int>>{{7, 8}, {9, 7}, {0, 0}}) {
    std::vector<DoubleMoments> block;
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i)
        block.push_back(to_double(pyramid[static_cast<std::size_t>((2 * y + j) * 32 + 2 * x + i)]));
    }
    const DoubleMoments expected = merge_moments(block, quarters);
    const DoubleMoments merged =
        to_double(pyramid[pyramid_offset(32, 1) + static_cast<std::size_t>(16 * y + x)]);
    expect_close(merged.position, expected.position, 1e-6, "position");
    expect_close(merged.flux, expected.flux, 1e-6, "flux");
    EXPECT_NEAR(merged.spread, expected.spread, 1e-5 * expected.spread);
  }
}

TEST(Pyramid, SameBytesOnAnyThreadCount) {
  const scene::Scene scene = mixed_scene();
  std::vector<Rsm> rsms;
  std::vector<GBuffer> gbuffers;
  for (const int threads : {1, 2}) {
    gpu::Device device({.threads = threads});
    Report report;
    Baker baker(scene, device, report);
    rsms.push_back(baker.rsm({96, 96, NormalConvention::consistent}));
    gbuffers.push_back(baker.gbuffer());
  }
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  EXPECT_TRUE(same(rsms[0].layers[0].pyramid, rsms[1].layers[0].pyramid));
  EXPECT_TRUE(same(rsms[0].layers[0].surface, rsms[1].layers[0].surface));
  EXPECT_TRUE(same(gbuffers[0].pixels, gbuffers[1].pixels));
}

TEST(Input, SizesOutsideTheRangeAreRefused) {
  expect_error(ErrorCode::out_of_range, {"4097"}, [] { bake(mixed_scene(), 4097, 16); });
  expect_error(ErrorCode::out_of_range, {"0"}, [] { bake(mixed_scene(), 0); });
}

TEST(Input, TwoLightsOfOneNameAreRefused) {
  scene::Scene scene = mixed_scene();
  scene.lights.push_back(scene.lights[0]);
  expect_error(ErrorCode::bad_light, {"key"}, [&] { bake(scene, 16); });
}

TEST(Input, DegenerateLightsAreRefused) {
  scene::Scene scene = mixed_scene();
  scene.lights[0].extent_x = 0;
  expect_error(ErrorCode::bad_light, {"key"}, [&] { bake(scene, 16); });
}

TEST(Input, IndicesThatPointNowhereAreRefused) {
  scene::Scene scene = mixed_scene();
  scene.instances[0].indices[2] = 99;
  expect_error(ErrorCode::mesh_invalid, {"99"}, [&] { bake(scene, 16); });
  scene = mixed_scene();
  scene.instances[0].material = 7;
  expect_error(ErrorCode::mesh_invalid, {"7"}, [&] { bake(scene, 16); });
  scene = mixed_scene();
  scene.materials[0].normal_texture = 0;
  expect_error(ErrorCode::mesh_invalid, {"texture 0"}, [&] { bake(scene, 16); });
}

// Whatever was baked before, a changed scene gives what a baker of its own makes of it.
TEST(Baker, FollowsEveryKindOfChange) {
  scene::Scene scene = test::scene_of(
      {test::tilted_plane(20), test::quad({-1, -1, -1}, {1, 0, 0}, {0, 1, 0})}, {test::spot(30, 40)});
  scene.textures = {test::stripes(8, 8, {{255, 0, 0, 255}, {0, 255, 0, 255}})};
  scene.materials[0].base_color_texture = 0;
  for (const VisibleBy visible : {VisibleBy::raster, VisibleBy::rays}) {
    scene::Scene changing = scene;
    Report report;
    Baker baker(changing, test::device(), report, visible);
    const auto expect_followed = [&](const char* what) {
      SCOPED_TRACE(what);
      baker.update();
      const Rsm followed = baker.rsm({32, 32});
      const Rsm fresh = Baker(changing, test::device(), report, visible).rsm({32, 32});
      ASSERT_EQ(followed.layers[0].surface.size(), fresh.layers[0].surface.size());
      EXPECT_EQ(0, std::memcmp(followed.layers[0].surface.data(), fresh.layers[0].surface.data(),
                               fresh.layers[0].surface.size() * sizeof(interop::Surface)));
    };
    expect_followed("nothing");
    for (scene::Vertex& vertex : changing.instances[1].vertices) vertex.position[0] += 0.3f;
    expect_followed("vertices");
    changing.instances[1].indices = {0, 1, 2};
    expect_followed("indices");
    changing.materials[0].base_color = {0.1, 0.2, 0.3};
    expect_followed("materials");
    changing.textures[0].rgba[0] = 0;
    expect_followed("texels");
    changing.textures.push_back(test::stripes(4, 4, {{0, 0, 255, 255}}));
    changing.materials[0].base_color_texture = 1;
    expect_followed("another texture");
    changing.lights[0].position.x = 0.1;
    expect_followed("lights");
  }
}

TEST(Report, SaysWhatWasBakedAndSkipped) {
  Report report;
  bake_rsm(test::scene_of(test::room(1), {test::spot(30, 30)}), {32, 32, NormalConvention::consistent},
           test::device(), report);
  const std::string text = report.to_json().dump();
  for (const char* part :
       {"\"triangles\":12", "\"instances\":6", "layer key", "lit_texels", "flux_w", "specular"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
}

TEST(MipChain, LevelsOfOddSizes) {
  const std::vector<std::uint32_t> chain = build_mip_chain(test::stripes(5, 3, {{10, 20, 30, 40}}));
  EXPECT_EQ(mip_levels(5, 3), 3);  // 5x3, 2x1, 1x1
  EXPECT_EQ(chain, std::vector<std::uint32_t>(15 + 2 + 1, 10u | 20u << 8 | 30u << 16 | 40u << 24));
}

TEST(MipChain, ColoursAreAveragedInLinearLight) {
  const auto linear = build_mip_chain(test::stripes(2, 2, {{0, 0, 0, 0}, {255, 255, 255, 255}}, false));
  EXPECT_EQ(linear.back(), 0x80808080u);
  const auto srgb = build_mip_chain(test::stripes(2, 2, {{0, 0, 0, 100}, {255, 255, 255, 100}}, true));
  EXPECT_EQ(srgb.back(), 0x64BCBCBCu);  // 188 is half as bright as 255; alpha is linear
}

TEST(MipChain, TexturesOfTheWrongSizeAreRefused) {
  scene::Texture texture = test::stripes(2, 2, {{0, 0, 0, 0}});
  texture.rgba.pop_back();
  expect_error(ErrorCode::texture_unreadable, {"stripes"}, [&] { build_mip_chain(texture); });
}

}  // namespace
}  // namespace vsgl
