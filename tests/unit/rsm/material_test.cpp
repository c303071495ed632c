// Reflectances, textures, normal maps and the light that surfaces send on.
#include <gtest/gtest.h>

#include "math/lobe.h"
#include "math/microfacet.h"
#include "scenes.h"

namespace vsgl {
namespace {

using test::bake;

constexpr std::size_t kMiddle = 64 * 31 + 40;  // a lit texel off the axis, of 64x64

scene::Scene plane_under_spot(double tilt_deg, const scene::Material& material) {
  scene::Scene scene = test::scene_of({test::tilted_plane(tilt_deg)}, {test::spot(40, 40)});
  scene.materials = {material};
  return scene;
}

TEST(Material, DiffusePowerAndLobe) {
  const Rsm rsm = bake(plane_under_spot(20, test::diffuse(0.25)), 64);
  const interop::Moments& m = rsm.layers[0].pyramid[kMiddle];
  const interop::Surface& s = rsm.layers[0].surface[kMiddle];
  EXPECT_FLOAT_EQ(m.power_diffuse.y, 0.25f * m.flux.y);
  EXPECT_FLOAT_EQ(m.weight,
                  0.2126f * m.power_diffuse.x + 0.7152f * m.power_diffuse.y + 0.0722f * m.power_diffuse.z);
  const SgLobe lobe = lobe_decode({to_double(m.diffuse_mean), static_cast<double>(m.diffuse_deficit)});
  EXPECT_NEAR(lobe.sharpness, static_cast<double>(interop::LAMBDA_DIFFUSE), 1e-5);
  EXPECT_NEAR(length(lobe.axis - to_double(s.normal)), 0, 1e-6);
  EXPECT_EQ(m.normal_deficit, 0);
  EXPECT_EQ(s.ndf, interop::NDF_NONE);
  EXPECT_FALSE(rsm.has_specular());
}

TEST(Material, SpecularLobeIsTheWarpedHalfVectorLobe) {
  scene::Material metal;
  metal.base_color = {0.9, 0.6, 0.3};
  metal.metallic = 1;
  metal.alpha = 0.1;
  const Rsm rsm = bake(plane_under_spot(20, metal), 64);
  EXPECT_TRUE(rsm.has_specular());
  const interop::Moments& m = rsm.layers[0].pyramid[kMiddle];
  const interop::Surface& s = rsm.layers[0].surface[kMiddle];
  EXPECT_EQ(m.power_diffuse.x, 0);
  EXPECT_FLOAT_EQ(m.power_specular.y, 0.6f * m.flux.y);
  const Vec3 to_light = -normalise(to_double(s.position)), n = to_double(s.normal);
  const double cosine = dot(n, to_light);
  const SgLobe lobe = lobe_decode({to_double(m.specular_mean), static_cast<double>(m.specular_deficit)});
  EXPECT_NEAR(length(lobe.axis - (2 * cosine * n - to_light)), 0, 1e-6);
  EXPECT_NEAR(lobe.sharpness / (ndf_sharpness(interop::NDF_GGX, 0.1) / (4 * cosine)), 1, 1e-5);
}

TEST(Material, DielectricSplitsItsReflectance) {
  scene::Material plastic;
  plastic.base_color = {0.5, 0.5, 0.5};
  plastic.metallic = 0.25;
  plastic.specular = {0.04, 0.04, 0.04};
  plastic.alpha = 0.3;
  plastic.ndf = interop::NDF_BECKMANN;
  const Rsm rsm = bake(plane_under_spot(0, plastic), 64);
  const interop::Surface& s = rsm.layers[0].surface[kMiddle];
  EXPECT_FLOAT_EQ(s.diffuse.x, 0.375f);
  EXPECT_FLOAT_EQ(s.specular.x, 0.04f * 0.75f + 0.5f * 0.25f);
  EXPECT_FLOAT_EQ(s.alpha, 0.3f);
  EXPECT_EQ(s.ndf, interop::NDF_BECKMANN);
}

TEST(Material, TexturesScaleTheFactors) {
  scene::Material material;
  material.base_color = {1, 1, 0.5};
  material.metallic = 1;
  material.alpha = 0.8;
  material.base_color_texture = 0;
  material.metallic_roughness_texture = 1;
  scene::Scene scene = plane_under_spot(0, material);
  scene.textures = {test::stripes(4, 4, {{188, 188, 188, 255}}, true),
                    test::stripes(4, 4, {{0, 128, 51, 255}})};
  const Rsm rsm = bake(scene, 64);
  const interop::Surface& s = rsm.layers[0].surface[kMiddle];
  const double base = 0.50289;  // sRGB 188
  EXPECT_NEAR(static_cast<double>(s.diffuse.x), base * 0.8, 1e-4);
  EXPECT_NEAR(static_cast<double>(s.diffuse.z), base * 0.4, 1e-4);
  EXPECT_NEAR(static_cast<double>(s.specular.x), 0.04 * 0.8 + base * 0.2, 1e-4);
  EXPECT_NEAR(static_cast<double>(s.alpha), 0.8 * std::pow(128 / 255.0, 2), 1e-5);
}

// 512 stripes of black and white over the plane: far finer than a texel, so its mean shows, taken in linear
// light.
TEST(Material, MinifiedTexturesShowTheirMean) {
  scene::Material material = test::diffuse(1);
  material.base_color_texture = 0;
  scene::Scene scene = plane_under_spot(0, material);
  std::vector<std::array<std::uint8_t, 4>> columns;
  for (int i = 0; i < 512; ++i) {
    const std::uint8_t c = i % 2 == 0 ? 0 : 255;
    columns.push_back({c, c, c, 255});
  }
  scene.textures = {test::stripes(512, 8, columns, true)};
  for (scene::Vertex& v : scene.instances[0].vertices) v.uv = {64 * v.uv[0], 64 * v.uv[1]};
  const Rsm rsm = bake(scene, 64);
  for (const interop::Surface& s : rsm.layers[0].surface) {
    if (s.id == interop::NO_INSTANCE) continue;
    ASSERT_NEAR(static_cast<double>(s.diffuse.x), 0.5, 4e-3);
  }
}

// Left half red, right half green; negative and large coordinates repeat.
TEST(Material, TexturesRepeatAndFollowTheirCoordinates) {
  scene::Material material = test::diffuse(1);
  material.base_color_texture = 0;
  scene::Scene scene = test::scene_of({test::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0})}, {});
  scene.materials = {material};
  scene.textures = {test::stripes(64, 4, {{255, 0, 0, 255}, {0, 255, 0, 255}})};
  scene.camera.tan_x = scene.camera.tan_y = 1;
  for (const float offset : {0.0f, -3.0f, 5.0f}) {
    scene::Scene shifted = scene;
    for (scene::Vertex& v : shifted.instances[0].vertices) v.uv[0] += offset;
    const GBuffer gbuffer = test::see(shifted);
    EXPECT_NEAR(static_cast<double>(gbuffer.pixels[64 * 24 + 16].diffuse.x), 1, 1e-5);
    EXPECT_NEAR(static_cast<double>(gbuffer.pixels[64 * 24 + 48].diffuse.y), 1, 1e-5);
    EXPECT_NEAR(static_cast<double>(gbuffer.pixels[64 * 24 + 48].diffuse.x), 0, 1e-5);
  }
}

TEST(Material, CutOutsHaveHoles) {
  scene::Material leaf = test::diffuse(1);
  leaf.base_color_texture = 0;
  leaf.alpha_cutoff = 0.5;
  scene::Scene scene = test::scene_of(
      {test::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), test::quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}, 1)},
      {});
  scene.materials = {leaf, test::diffuse(0.5)};
  scene.textures = {test::stripes(64, 4, {{255, 255, 255, 0}, {255, 255, 255, 255}})};
  scene.camera.tan_x = scene.camera.tan_y = 1;
  const GBuffer gbuffer = test::see(scene);
  EXPECT_EQ(gbuffer.pixels[64 * 24 + 16].id, 1u);
  EXPECT_EQ(gbuffer.pixels[64 * 24 + 48].id, 0u);
}

// A normal map that tilts every normal by `degrees` along the tangent.
scene::Scene bent_plane(double degrees, double tilt_deg) {
  scene::Material material = test::diffuse(0.5);
  material.specular = {0.25, 0.25, 0.25};
  material.alpha = 0.2;
  material.normal_texture = 0;
  scene::Scene scene = plane_under_spot(tilt_deg, material);
  const double a = degrees * std::numbers::pi / 180;
  const auto encode = [](double v) { return static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * v)); };
  scene.textures = {test::stripes(2, 2, {{encode(std::sin(a)), 128, encode(std::cos(a)), 255}})};
  return scene;
}

TEST(NormalMap, BendsTowardsTheTangentAndBitangent) {
  scene::Scene scene = bent_plane(30, 0);
  interop::Surface s = bake(scene, 64).layers[0].surface[kMiddle];
  EXPECT_NEAR(static_cast<double>(s.shading_normal.x), 0.5, 0.01);
  EXPECT_NEAR(static_cast<double>(s.shading_normal.z), std::sqrt(0.75), 0.01);
  EXPECT_NEAR(static_cast<double>(s.normal.z), 1, 1e-6);
  scene.textures[0] = test::stripes(2, 2, {{128, 191, 238, 255}});  // 30 degrees along the bitangent
  s = bake(scene, 64).layers[0].surface[kMiddle];
  EXPECT_NEAR(static_cast<double>(s.shading_normal.y), 0.5, 0.01);
  for (scene::Vertex& v : scene.instances[0].vertices) v.tangent[3] = -1;
  s = bake(scene, 64).layers[0].surface[kMiddle];
  EXPECT_NEAR(static_cast<double>(s.shading_normal.y), -0.5, 0.01);
}

// Pixels and texels far wider than the map's, whose normals lean 30 degrees to one side and the other.
scene::Scene fine_bumps() {
  scene::Scene scene = bent_plane(0, 20);
  scene.textures[0] = test::stripes(2, 2, {{191, 128, 238, 255}, {64, 128, 238, 255}});
  for (scene::Vertex& v : scene.instances[0].vertices) v.uv = {10000 * v.uv[0], 10000 * v.uv[1]};
  scene.camera.tan_x = scene.camera.tan_y = 1;
  return scene;
}

// Their mean reflects what they reflect together, and their lobes together are a wider one.
TEST(NormalMap, TheCameraSeesTheMeanOfFilteredNormals) {
  const interop::Surface s = test::see(fine_bumps()).pixels[64 * 24 + 32];
  const double cosine = std::cos(std::numbers::pi / 6);
  EXPECT_NEAR(length(to_double(s.shading_normal) - to_double(s.normal)), 0, 0.01);
  EXPECT_NEAR(static_cast<double>(s.diffuse.x), 0.5 * cosine, 0.005);
  EXPECT_NEAR(static_cast<double>(s.alpha), std::sqrt(0.2 * 0.2 + 2 * (1 / cosine - 1)), 0.01);
}

// What the lit texels send on together is the mean over the map, interpolated between its texels as at full
// resolution: of cos(atan(x / cos 30)) over -1/2 < x < 1/2.
TEST(NormalMap, TheLightSumsOverNormals) {
  const Rsm rsm = bake(fine_bumps(), 64);
  const RsmLayer& layer = rsm.layers[0];
  double flux = 0, diffuse = 0, specular = 0;
  for (std::size_t i = 0; i < layer.surface.size(); ++i) {
    const interop::Moments& m = layer.pyramid[i];
    flux += static_cast<double>(m.flux.x);
    diffuse += static_cast<double>(m.power_diffuse.x);
    specular += static_cast<double>(m.power_specular.x);
    if (layer.surface[i].id != interop::NO_INSTANCE) {
      ASSERT_FLOAT_EQ(layer.surface[i].alpha, 0.2f);
    }
  }
  const double cosine = std::sqrt(0.75), mean = 2 * cosine * std::asinh(0.5 / cosine);
  EXPECT_NEAR(diffuse / flux, 0.5 * mean, 0.002);
  EXPECT_NEAR(specular / flux, 0.25 * mean, 0.004);
}

TEST(NormalMap, ConsistentPowerCarriesTheRatioOfCosines) {
  const Rsm rsm = bake(bent_plane(30, 20), 64);
  const interop::Surface& s = rsm.layers[0].surface[kMiddle];
  const interop::Moments& m = rsm.layers[0].pyramid[kMiddle];
  const Vec3 to_light = -normalise(to_double(s.position));
  const double kappa = dot(to_double(s.shading_normal), to_light) / dot(to_double(s.normal), to_light);
  EXPECT_GT(std::abs(kappa - 1), 0.05);
  EXPECT_NEAR(static_cast<double>(m.power_diffuse.x / m.flux.x), 0.5 * kappa, 1e-5);
  EXPECT_NEAR(static_cast<double>(m.power_specular.x / m.flux.x), 0.25 * kappa, 1e-5);
  EXPECT_NEAR(length(normalise(to_double(m.diffuse_mean)) - to_double(s.normal)), 0, 1e-6);
  const Vec3 mirror = 2 * dot(to_double(s.shading_normal), to_light) * to_double(s.shading_normal) - to_light;
  EXPECT_NEAR(length(normalise(to_double(m.specular_mean)) - mirror), 0, 1e-5);
}

TEST(NormalMap, PaperConventionUsesTheShadingNormalAlone) {
  const Rsm rsm = bake(bent_plane(30, 20), 64, 64, NormalConvention::paper);
  const interop::Surface& s = rsm.layers[0].surface[kMiddle];
  const interop::Moments& m = rsm.layers[0].pyramid[kMiddle];
  EXPECT_FLOAT_EQ(m.power_diffuse.x, 0.5f * m.flux.x);
  EXPECT_NEAR(length(normalise(to_double(m.diffuse_mean)) - to_double(s.shading_normal)), 0, 1e-6);
  EXPECT_NEAR(length(to_double(m.normal_mean) - to_double(s.normal)), 0, 1e-6);
}

TEST(NormalMap, NormalsBentAwayFromTheLightReflectNothing) {
  const Rsm rsm = bake(bent_plane(80, 20), 64);  // 100 degrees from the axis of the spot
  int dark = 0, lit = 0;
  for (std::size_t i = 0; i < rsm.layers[0].surface.size(); ++i) {
    const interop::Surface& s = rsm.layers[0].surface[i];
    const interop::Moments& m = rsm.layers[0].pyramid[i];
    if (s.id == interop::NO_INSTANCE) continue;
    EXPECT_GT(m.flux.x, 0);
    const bool away = dot(to_double(s.shading_normal), to_double(s.position)) > 1e-6;
    EXPECT_TRUE(!away || m.weight == 0);
    (away ? dark : lit) += 1;
  }
  EXPECT_GT(dark, 100);
  EXPECT_GT(lit, 100);
}

TEST(NormalMap, KappaIsClampedAndCounted) {
  Report report;
  const Rsm rsm =
      bake_rsm(bent_plane(80, -87), {64, 64, NormalConvention::consistent}, test::device(), report);
  float largest = 0;
  for (std::size_t i = 0; i < rsm.layers[0].surface.size(); ++i) {
    const interop::Moments& m = rsm.layers[0].pyramid[i];
    if (m.flux.x > 0) largest = std::max(largest, m.power_diffuse.x / m.flux.x);
  }
  const auto counts = report.to_json();
  const std::string text = counts.dump();
  EXPECT_NE(text.find("clamped_texels"), std::string::npos);
  EXPECT_EQ(text.find("\"clamped_texels\":0"), std::string::npos) << text;
  EXPECT_NEAR(largest, 0.5f * 8, 1e-4f);
}

}  // namespace
}  // namespace vsgl
