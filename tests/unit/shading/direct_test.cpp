// Direct light from a layer of a reflective shadow map.

#include <numbers>

#include "../expect_error.h"
#include "run.h"

namespace vsgl {
namespace {

constexpr int kRsmSize = 128;

LightSource lamp(LightType type) {
  LightSource light;
  light.type = type;
  light.position = {0, 2, 0};
  light.forward = {0, -1, 0};
  light.right = {1, 0, 0};
  light.up = {0, 0, -1};
  light.intensity = {3, 2, 1};
  light.cos_inner = 0.95;
  light.cos_outer = 0.8;
  return light;
}

// The floor y = 0 as the light sees it, with a square of half width 0.2 at y = 1 above its centre.
Rsm floor_rsm(LightType type, bool occluder) {
  Rsm rsm;
  rsm.size = rsm.width = rsm.height = kRsmSize;
  rsm.scene_radius = 2;
  RsmLayer layer;
  layer.light = lamp(type);
  for (int j = 0; j < kRsmSize; ++j)
    for (int i = 0; i < kRsmSize; ++i) {
      const Vec3 plane = (2 * (i + 0.5) / kRsmSize - 1) * layer.light.right +
                         (1 - 2 * (j + 0.5) / kRsmSize) * layer.light.up;
      const bool parallel = type == LightType::directional;
      const Vec3 direction = parallel ? layer.light.forward : layer.light.forward + plane;  // y component -1
      const Vec3 origin = parallel ? layer.light.position + plane : layer.light.position;
      const Vec3 above = origin + direction;
      const bool blocked = occluder && std::abs(above.x) < 0.2 && std::abs(above.z) < 0.2;
      const Vec3 hit = blocked ? above : origin + 2 * direction;
      interop::Surface s;
      s.position = test::to_float(hit);
      s.normal = s.shading_normal = {0, 1, 0};
      s.alpha = 1;
      s.id = 0;
      s.depth = static_cast<float>(length(hit - origin));
      layer.surface.push_back(s);
    }
  rsm.layers.push_back(layer);
  return rsm;
}

GBuffer floor_gbuffer(int size, std::uint32_t ndf) {
  GBuffer gbuffer;
  gbuffer.width = gbuffer.height = size;
  gbuffer.scene_radius = 2;
  gbuffer.camera = {0.5, 1, 0.7};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      interop::Surface s;
      s.position = {static_cast<float>((x + 0.5) / size * 6 - 3), 0,
                    static_cast<float>((y + 0.5) / size * 6 - 3)};
      s.normal = {0, 1, 0};
      s.shading_normal = test::to_float(normalise(Vec3{0.1, 1, 0.05}));
      s.diffuse = {0.5f, 0.4f, 0.3f};
      s.specular = ndf == interop::NDF_NONE ? interop::vec3{} : interop::vec3{0.2f, 0.2f, 0.2f};
      s.ndf = ndf;
      s.alpha = ndf == interop::NDF_NONE ? 1.0f : 0.3f;
      s.id = 0;
      gbuffer.pixels.push_back(s);
    }
  return gbuffer;
}

Vec3 expected_radiance(const GBuffer& gbuffer, std::size_t i, const LightSource& light) {
  const test::OraclePixel p(gbuffer, i);
  const bool parallel = light.type == LightType::directional;
  const Vec3 to = parallel ? light.forward : normalise(p.position - light.position);
  const Vec3 v = p.position - light.position;
  const double along = parallel ? 1 : dot(v, light.forward);
  if (std::abs(dot(v, light.right)) > along * light.extent_x ||
      std::abs(dot(v, light.up)) > along * light.extent_y)
    return {};
  const Vec3 irradiance = intensity_towards(light, to) / (parallel ? 1 : dot(v, v));
  Vec3 brdf = test::to_double(p.surface.diffuse) * (std::max(dot(p.normal, -to), 0.0) / std::numbers::pi);
  if (p.is_specular())
    brdf += test::to_double(p.surface.specular) *
            specular_brdf_cos(p.surface.ndf, p.surface.alpha, p.normal, p.view, -to);
  return irradiance * brdf;
}

std::vector<interop::vec3> direct(const GBuffer& gbuffer, const Rsm& rsm) {
  Report report;
  Indirect image;
  shade_direct(gbuffer, rsm, test::shared_device(), report, image);
  return image.direct;
}

TEST(Direct, IsTheExactRadianceOfEachTypeOfLight) {
  for (LightType type : {LightType::spot, LightType::directional, LightType::point})
    for (std::uint32_t ndf : {interop::NDF_NONE, interop::NDF_GGX}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(type) << " ndf " << ndf);
      const GBuffer gbuffer = floor_gbuffer(16, ndf);
      const Rsm rsm = floor_rsm(type, false);
      const auto image = direct(gbuffer, rsm);
      int lit = 0;
      for (std::size_t i = 0; i < image.size(); ++i) {
        const Vec3 expected = expected_radiance(gbuffer, i, rsm.layers[0].light);
        EXPECT_LE(length(test::to_double(image[i]) - expected), 2e-5 * length(expected) + 1e-7) << i;
        lit += length(expected) > 0;
      }
      EXPECT_GT(lit, 10);
      EXPECT_LT(lit, 256);
    }
}

// The occluder's shadow has half width 0.4 (from a point at twice its height) or 0.2 (parallel rays).
TEST(Direct, IsShadowed) {
  for (LightType type : {LightType::point, LightType::directional}) {
    SCOPED_TRACE(static_cast<int>(type));
    const GBuffer gbuffer = floor_gbuffer(128, interop::NDF_NONE);
    const auto open = direct(gbuffer, floor_rsm(type, false)),
               shadowed = direct(gbuffer, floor_rsm(type, true));
    double area = 0;
    for (std::size_t i = 0; i < open.size(); ++i)
      if (open[i].x > 0) area += (1 - static_cast<double>(shadowed[i].x / open[i].x)) * 36 / (128.0 * 128.0);
    const double expected = type == LightType::point ? 0.64 : 0.16;
    EXPECT_NEAR(area, expected, 0.08 * expected);
  }
}

TEST(Direct, SumsItsLayers) {
  const GBuffer gbuffer = floor_gbuffer(8, interop::NDF_NONE);
  Rsm rsm = floor_rsm(LightType::spot, false);
  const auto one = direct(gbuffer, rsm);
  rsm.layers.push_back(rsm.layers.front());
  const auto two = direct(gbuffer, rsm);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_FLOAT_EQ(two[i].x, 2 * one[i].x);
  rsm.anchor = {5, 0, 0};
  test::expect_error(ErrorCode::invalid_data, {"RSM", "anchor"}, [&] { direct(gbuffer, rsm); });
}

}  // namespace
}  // namespace vsgl
