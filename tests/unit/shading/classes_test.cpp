// Classes of pixels and lights, determinism and degenerate input.

#include <cstring>

#include "run.h"

namespace vsgl {
namespace {

using test::BoxOptions;

// Pixels of every class side by side, some of them background, and lights of every class.
GBuffer mixed_gbuffer(double tilt) {
  BoxOptions options;
  options.tilt = tilt;
  GBuffer gbuffer = test::box_gbuffer(options);
  for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
    interop::Surface& s = gbuffer.pixels[i];
    s.ndf = static_cast<std::uint32_t>(i % 4);
    if (s.ndf != interop::NDF_NONE) {
      s.specular = {0.3f, 0.2f, 0.1f};
      s.alpha = 0.1f * static_cast<float>(1 + i % 7);
    }
    if (i % 11 == 0) s = test::background();
  }
  return gbuffer;
}

Lights mixed_lights() {
  BoxOptions options;
  options.lights = 40;
  options.emission_ndf = interop::NDF_GGX;
  Lights lights = test::box_lights(options);
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    lights.lights[i].ndf = i % 2 ? interop::NDF_PHONG : interop::NDF_NONE;
    if (i % 2 == 0) lights.lights[i].power_specular = {};
  }
  return lights;
}

double relative_difference(const std::vector<interop::vec3>& a, const std::vector<interop::vec3>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 x = test::to_double(a[i]), y = test::to_double(b[i]);
    if (length(x) > 0 || length(y) > 0)
      worst = std::max(worst, length(x - y) / std::max(length(x), length(y)));
  }
  return worst;
}

TEST(Classes, AgreeWithTheGeneralPipeline) {
  const Lights lights = mixed_lights();
  for (auto [method, tilt] :
       {std::pair{"fvpl", 0.1}, {"vpl", 0.1}, {"vsl", 0.1}, {"vsgl", 0.1}, {"vsgl-2014", 0.0}}) {
    SCOPED_TRACE(testing::Message() << method << " tilt " << tilt);
    const GBuffer gbuffer = mixed_gbuffer(tilt);
    const Indirect special = test::shade_box(gbuffer, lights, {.light_model = method});
    const Indirect general = test::shade_box(gbuffer, lights, {.light_model = method, .skip = false});
    EXPECT_LT(relative_difference(special.diffuse, general.diffuse), 1e-6);
    EXPECT_LT(relative_difference(special.specular, general.specular), 1e-6);
    for (std::size_t i = 0; i < gbuffer.pixels.size(); i += 11)
      EXPECT_EQ(length(test::to_double(general.diffuse[i])), 0);
  }
}

TEST(Classes, ReportWhatTheSceneDoesNotNeed) {
  Report report;
  shade(test::box_gbuffer({}), test::box_lights({}), nullptr, {}, test::shared_device(), report);
  const std::string skipped = report.to_json()["skipped"].dump();
  for (const char* what : {"specular reflection", "specular emission", "visibility", "geometric horizon"})
    EXPECT_NE(skipped.find(what), std::string::npos) << what << " is not in " << skipped;
}

TEST(Classes, SumMoreLightsThanABlockHolds) {
  BoxOptions options;
  options.width = 4;
  options.height = 2;
  options.lights = 1000;
  const GBuffer gbuffer = test::box_gbuffer(options);
  const Lights lights = test::box_lights(options);
  test::expect_near_oracle(
      test::shade_box(gbuffer, lights, {.light_model = "vsgl", .cbr = 0}),
      [&](std::size_t i) { return test::vsgl_sum(gbuffer, i, lights, false); }, 1e-4);
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(Determinism, SameBytesForAnyNumberOfThreads) {
  GBuffer gbuffer = mixed_gbuffer(0.1);
  while (gbuffer.pixels.size() < 4000)
    gbuffer.pixels.insert(gbuffer.pixels.end(), gbuffer.pixels.begin(), gbuffer.pixels.begin() + 144);
  gbuffer.height = static_cast<int>(gbuffer.pixels.size()) / gbuffer.width;
  const Lights lights = mixed_lights();
  Indirect images[2];
  for (int threads : {1, 2}) {
    gpu::Device device({.threads = threads, .compute_only = true});
    Report report;
    images[threads - 1] = shade(gbuffer, lights, nullptr, {}, device, report);
  }
  EXPECT_TRUE(same_bytes(images[0].diffuse, images[1].diffuse));
  EXPECT_TRUE(same_bytes(images[0].specular, images[1].specular));
  EXPECT_TRUE(same_bytes(images[0].cancellation, images[1].cancellation));
}

std::vector<std::pair<std::string, std::string>> models_with_lobes() {
  std::vector<std::pair<std::string, std::string>> all;
  for (const LightModel& model : light_models())
    for (const SpecularLobe& lobe : specular_lobes())
      if (model.has_lobe || lobe.name == "auto") all.push_back({model.name, lobe.name});
  return all;
}

// In the general pipeline, which holds the code of all others.
TEST(Degenerate, StaysFinite) {
  GBuffer gbuffer = mixed_gbuffer(0);
  Lights lights = mixed_lights();
  for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
    interop::Surface& s = gbuffer.pixels[i];
    if (s.ndf != interop::NDF_NONE) s.alpha = i % 3 == 0 ? 1.0f : interop::ALPHA_MIN;
    if (i % 5 == 0)
      s.shading_normal =
          test::to_float(normalise(cross(test::to_double(s.position), {0.3, 1, 0.2})));  // grazing view
  }
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    interop::Light& light = lights.lights[i];
    if (i % 3 == 0) light.variance = 0;
    if (i % 3 == 1) light.variance = 100;
    if (i % 2 == 0) light.position = light.origin = gbuffer.pixels[3 * i + 1].position;  // in a pixel
    if (i % 5 == 0) light.specular_sharpness = light.diffuse_sharpness = 0;
    if (i % 5 == 1) light.specular_sharpness = 1e12f;
    light.ndf = light.ndf == interop::NDF_NONE ? light.ndf : static_cast<std::uint32_t>(1 + i % 3);
    light.alpha = i % 4 == 1 ? 1.0f : interop::ALPHA_MIN;
  }
  for (const auto& [method, lobe] : models_with_lobes())
    for (double cbr : {0.0, 1.0}) {
      const Indirect image = test::shade_box(
          gbuffer, lights, {.light_model = method, .specular_lobe = lobe, .cbr = cbr, .skip = false});
      for (std::size_t i = 0; i < image.diffuse.size(); ++i) {
        const Vec3 d = test::to_double(image.diffuse[i]), s = test::to_double(image.specular[i]);
        ASSERT_TRUE(std::isfinite(d.x + d.y + d.z + s.x + s.y + s.z))
            << method << " " << lobe << " " << cbr << " pixel " << i;
        ASSERT_GE(std::min({d.x, d.y, d.z, s.x, s.y, s.z}), 0) << method << " " << lobe << " pixel " << i;
      }
      for (float share : image.cancellation) ASSERT_TRUE(share >= 0 && share <= 1);
    }
}

}  // namespace
}  // namespace vsgl
