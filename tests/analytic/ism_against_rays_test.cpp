// Shadow maps against exact bits: they differ where shadows begin and end.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "math/interop_vec.h"
#include "stages/lights/lights.h"
#include "stages/pdf/pdf.h"
#include "stages/rsm/rsm.h"
#include "stages/visibility/shadow_lookup.h"
#include "stages/visibility/visibility.h"
#include "test_scene.h"

namespace vsgl::test {
namespace {

constexpr int kReach = 3;  // pixels from a pixel to the boundary of an exact shadow that still count as near

struct Scene {
  GBuffer gbuffer;
  Lights lights;
  ShadowMaps maps;
  VisibilityBits bits;
};

Scene cornell() {
  const scene::Scene scene = test_scene("cornell", 96, 54);
  gpu::Device device({});
  Report report;
  Baker baker(scene, device, report);
  RsmParams rsm_params;
  rsm_params.width = rsm_params.height = 128;
  const Rsm rsm = baker.rsm(rsm_params);
  Scene out{baker.gbuffer(), {}, {}, {}};
  const Pdf pdf = build_pdf(rsm, &out.gbuffer, {.method = "flux"}, device, report);
  out.lights = generate_lights(rsm, &pdf, {.method = "fis-2016", .count = 256}, &device, report);
  const auto look = [&](const char* method) {
    return build_visibility({scene, out.lights, &out.gbuffer}, {.method = method}, &device, report);
  };
  out.maps = std::get<ShadowMaps>(look("ism"));
  out.bits = std::get<VisibilityBits>(look("raytraced"));
  return out;
}

// Whether a pixel within reach is of another surface (background included), or sees the light differently.
bool near_boundary(const Scene& scene, std::size_t light, int x, int y) {
  const int width = scene.gbuffer.width, height = scene.gbuffer.height;
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(j * width + i); };
  const std::size_t here = at(x, y);
  for (int j = std::max(y - kReach, 0); j <= std::min(y + kReach, height - 1); ++j)
    for (int i = std::max(x - kReach, 0); i <= std::min(x + kReach, width - 1); ++i)
      if (scene.gbuffer.pixels[at(i, j)].id != scene.gbuffer.pixels[here].id ||
          scene.bits.visible(light, at(i, j)) != scene.bits.visible(light, here))
        return true;
  return false;
}

TEST(IsmAgainstRays, DifferNearBoundaries) {
  const Scene scene = cornell();
  std::size_t pairs = 0, differing = 0, far = 0;
  for (std::size_t light = 0; light < scene.lights.lights.size(); ++light)
    for (int y = 0; y < scene.gbuffer.height; ++y)
      for (int x = 0; x < scene.gbuffer.width; ++x) {
        const auto pixel = static_cast<std::size_t>(y * scene.gbuffer.width + x);
        const interop::Surface& s = scene.gbuffer.pixels[pixel];
        if (s.id == interop::NO_INSTANCE) continue;
        const Vec3 position = to_double(s.position), normal = to_double(s.normal);
        const Vec3 v = to_double(scene.lights.lights[light].origin) - position;
        if (dot(v, normal) <= 0) continue;  // maps leave the receiver's own horizon to shading
        ++pairs;
        const bool lit = shadow_visibility(scene.maps, light, position, normal) >= 0.5;
        if (lit == scene.bits.visible(light, pixel)) continue;
        ++differing;
        far += !near_boundary(scene, light, x, y);
      }
  const auto share = [&](std::size_t n) { return static_cast<double>(n) / static_cast<double>(pairs); };
  std::printf("%zu pairs: maps and rays differ in %.2f%%, away from boundaries in %.2f%%\n", pairs,
              100 * share(differing), 100 * share(far));
  EXPECT_LT(share(differing), 0.06);
  EXPECT_LT(share(far), 0.01);
}

}  // namespace
}  // namespace vsgl::test
