// Moving a scene far from the origin changes nothing but its anchor.

#include <gtest/gtest.h>

#include <cstdio>

#include "stages/lights/lights.h"
#include "stages/pdf/pdf.h"
#include "stages/rsm/rsm.h"
#include "stages/shading/shading.h"
#include "stages/visibility/visibility.h"
#include "test_scene.h"

namespace vsgl::test {
namespace {

struct Render {
  GBuffer gbuffer;
  Indirect image;
};

// The whole chain, visibility included.
Render render(const std::string& name, Vec3 offset) {
  scene::GenerateOptions options;
  options.width = 96;
  options.height = 54;
  options.offset = offset;
  const scene::Scene scene = test_scene(name, options);
  gpu::Device device({});
  Report report;
  RsmParams rsm_params;
  rsm_params.width = rsm_params.height = 128;
  Baker baker(scene, device, report);
  const Rsm rsm = baker.rsm(rsm_params);
  Render out{baker.gbuffer(), {}};
  PdfParams pdf_params;
  pdf_params.gbuffer_lights = 256;
  const Pdf pdf = build_pdf(rsm, &out.gbuffer, pdf_params, device, report);
  LightsParams lights_params;
  lights_params.method = "fis-2016";
  lights_params.count = 256;
  const Lights lights = generate_lights(rsm, &pdf, lights_params, &device, report);
  const Visibility maps = build_visibility({scene, lights}, {}, &device, report);
  out.image = shade(out.gbuffer, lights, &maps, {}, device, report);
  return out;
}

// Another surface, or a point that moved by more than a thousandth of the scene: the silhouette of something.
bool surface_changed(const interop::Surface& a, const interop::Surface& b, double scene_radius) {
  const double dx = a.position.x - b.position.x, dy = a.position.y - b.position.y,
               dz = a.position.z - b.position.z;
  return a.id != b.id || std::sqrt(dx * dx + dy * dy + dz * dz) > 1e-3 * scene_radius;
}

class FarFromTheOrigin : public testing::TestWithParam<const char*> {};

TEST_P(FarFromTheOrigin, SameImage) {
  const Render home = render(GetParam(), {}), away = render(GetParam(), {1000, 1000, 1000});
  EXPECT_NEAR(away.gbuffer.anchor.x - home.gbuffer.anchor.x, 1000, 1e-9);
  double error = 0, mean = 0;
  std::size_t compared = 0, left_out = 0, seen = 0;
  const auto radiance = [](const Indirect& image, std::size_t i) {
    const auto& d = image.diffuse[i];
    const auto s = image.specular.empty() ? interop::vec3{} : image.specular[i];
    return luminance({d.x + s.x, d.y + s.y, d.z + s.z});
  };
  for (std::size_t i = 0; i < home.gbuffer.pixels.size(); ++i) {
    const auto &a = home.gbuffer.pixels[i], &b = away.gbuffer.pixels[i];
    if (a.id == interop::NO_INSTANCE && b.id == interop::NO_INSTANCE) continue;
    ++seen;
    if (surface_changed(a, b, home.gbuffer.scene_radius)) {
      ++left_out;
      continue;
    }
    ++compared;
    mean += radiance(home.image, i);
  }
  mean /= static_cast<double>(compared);
  ASSERT_GT(mean, 0);
  for (std::size_t i = 0; i < home.gbuffer.pixels.size(); ++i) {
    if (surface_changed(home.gbuffer.pixels[i], away.gbuffer.pixels[i], home.gbuffer.scene_radius)) continue;
    const double exact = radiance(home.image, i), difference = radiance(away.image, i) - exact;
    error += difference * difference / (exact * exact + 4e-4 * mean * mean);
  }
  error /= static_cast<double>(compared);
  std::printf("%s: relMSE %.3g, %zu of %zu pixels left out\n", GetParam(), error, left_out, seen);
  EXPECT_LT(error, 1e-6);
  EXPECT_LT(static_cast<double>(left_out), 0.001 * static_cast<double>(seen));
}

INSTANTIATE_TEST_SUITE_P(Scenes, FarFromTheOrigin,
                         testing::Values("cornell-glossy", "caustic-ring", "atrium"), [](const auto& entry) {
                           std::string name = entry.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace vsgl::test
