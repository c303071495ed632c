// Diffuse light at half resolution: exact where interpolation would not do.

#include "cut_scene.h"
#include "stages/shading/cut_pixels.h"

namespace vsgl {
namespace {

constexpr int kWidth = 50, kHeight = 34;

// A floor seen from above, 2 cm a pixel; `height` of each pixel.
template <class Height>
GBuffer floor_of(Height height) {
  GBuffer gbuffer;
  gbuffer.width = kWidth;
  gbuffer.height = kHeight;
  gbuffer.camera = {0, 0, 3};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      interop::Surface s;
      s.position = {0.02f * static_cast<float>(x - kWidth / 2), 0.02f * static_cast<float>(y - kHeight / 2),
                    height(x)};
      s.normal = s.shading_normal = {0, 0, 1};
      s.alpha = 1;
      s.id = 0;
      s.diffuse = {0.5f, 0.5f, 0.5f};
      gbuffer.pixels.push_back(s);
    }
  return gbuffer;
}
float flat(int) {
  return 0;
}

// A ceiling of small lights.
Lights ceiling() {
  Lights lights;
  lights.method = "tree";
  test::Uniform uniform;
  for (int i = 0; i < 60; ++i) {
    interop::Light light{};
    light.position = light.origin = test::to_float({3 * uniform() - 1.5, 3 * uniform() - 1.5, 1.5});
    light.variance = 1e-3f;
    light.power_diffuse = {0.3f, 0.2f, 0.1f};
    light.normal = light.shading_normal = light.diffuse_axis = {0, 0, -1};
    lights.lights.push_back(light);
  }
  return lights;
}

Indirect at_scale(int scale, const GBuffer& gbuffer, const Cut& cut, Report* report = nullptr) {
  return test::shade_by(cut, gbuffer, ceiling(), {.diffuse_scale = scale}, report);
}

TEST(HalfResolution, EqualsFullOnAPlane) {
  const GBuffer gbuffer = floor_of(flat);
  Cut cut = test::whole_cut(gbuffer, ceiling());
  cut.error = 0.1;
  Report report;
  const Indirect half = at_scale(2, gbuffer, cut, &report), full = at_scale(1, gbuffer, cut);
  EXPECT_LT(test::difference(half.diffuse, full.diffuse), 1e-3);
  // Only beyond the last samples: the image's last row and column.
  EXPECT_EQ(report.to_json()["counts"]["diffuse_exact_pixels"],
            kWidth / 2 + kHeight / 2 + kWidth / 2 + kHeight / 2 - 1);
}

TEST(HalfResolution, InterpolatesLessWhereTheErrorIsSmaller) {
  const GBuffer gbuffer = floor_of(flat);
  Cut cut = test::whole_cut(gbuffer, ceiling());
  double exact = 0;
  for (const double error : {0.1, 1e-3, 0.0}) {
    cut.error = error;
    Report report;
    at_scale(2, gbuffer, cut, &report);
    const double found = report.to_json()["counts"]["diffuse_exact_pixels"];
    EXPECT_GT(found, exact);
    exact = found;
  }
}

TEST(HalfResolution, DoesNotLeakAcrossAStep) {
  const GBuffer gbuffer = floor_of([](int x) { return x < 23 ? 0.0f : 0.4f; });
  Cut cut = test::whole_cut(gbuffer, ceiling());
  cut.error = 0.1;
  // The upper side sees nothing.
  test::add_masks(cut, [&](std::size_t e, std::uint32_t x, std::uint32_t) {
    const std::size_t tile = e / ceiling().lights.size();
    return static_cast<int>(tile) % cut.columns() * 16 + static_cast<int>(x) < 23;
  });
  const Indirect half = at_scale(2, gbuffer, cut), full = at_scale(1, gbuffer, cut);
  EXPECT_LT(test::difference(half.diffuse, full.diffuse), 1e-3);
  EXPECT_EQ(half.diffuse[23].x, 0);
  EXPECT_GT(half.diffuse[22].x, 0);
}

TEST(HalfResolution, DoesNotLeakAcrossTheEdgeOfAShadow) {
  const GBuffer gbuffer = floor_of(flat);
  Cut cut = test::whole_cut(gbuffer, ceiling());
  cut.error = 0.1;
  test::add_masks(cut, [&](std::size_t e, std::uint32_t x, std::uint32_t) {
    const std::size_t tile = e / ceiling().lights.size();
    return static_cast<int>(tile) % cut.columns() * 16 + static_cast<int>(x) < 23;
  });
  EXPECT_LT(test::difference(at_scale(2, gbuffer, cut).diffuse, at_scale(1, gbuffer, cut).diffuse), 1e-3);
}

TEST(HalfResolution, ShadesBentNormalsExactly) {
  GBuffer gbuffer = floor_of(flat);
  test::Uniform uniform;
  for (interop::Surface& s : gbuffer.pixels)
    s.shading_normal = test::to_float(normalise(Vec3{0, 0, 1} + 0.5 * uniform.vector()));
  Cut cut = test::whole_cut(gbuffer, ceiling());
  cut.error = 0.1;
  Report report;
  EXPECT_LT(test::difference(at_scale(2, gbuffer, cut, &report).diffuse, at_scale(1, gbuffer, cut).diffuse),
            0.06);
  EXPECT_GT(report.to_json()["counts"]["diffuse_exact_pixels"], kWidth * kHeight / 2);
}

// A normal map that bends the normal by up to 0.03.
TEST(HalfResolution, InterpolatesBendsThatTheErrorAllows) {
  GBuffer gbuffer = floor_of(flat);
  test::Uniform uniform;
  for (interop::Surface& s : gbuffer.pixels)
    s.shading_normal = test::to_float(normalise(Vec3{0.03 * (2 * uniform() - 1), 0, 1}));
  const std::vector<std::uint8_t> kinds = pixel_kinds(gbuffer);
  EXPECT_LT(HalfResolution(gbuffer, kinds, 0.1).exact_pixels(), kWidth * kHeight / 10);
  EXPECT_GT(HalfResolution(gbuffer, kinds, 0.005).exact_pixels(), kWidth * kHeight / 2);
}

TEST(HalfResolution, ShadesSinglePixelsOfOtherSurfacesExactly) {
  GBuffer gbuffer = floor_of(flat);
  interop::Surface& wire = gbuffer.pixels[11 * kWidth + 17];  // not a sample
  wire.position.z = 0.3f;
  wire.normal = wire.shading_normal = {1, 0, 0};
  const std::vector<std::uint8_t> kinds = pixel_kinds(gbuffer);
  const HalfResolution half(gbuffer, kinds, 0.1);
  EXPECT_TRUE(half.shaded()[11 * kWidth + 17]);
  EXPECT_FALSE(half.shaded()[11 * kWidth + 19]);
}

}  // namespace
}  // namespace vsgl
