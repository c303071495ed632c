// With exact visibility and every RSM texel as an exact point light the chain computes the same integral as
// the ground truth.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "math/interop_vec.h"
#include "reference/reference.h"
#include "stages/lights/lights.h"
#include "stages/rsm/rsm.h"
#include "stages/shading/shading.h"
#include "stages/visibility/visibility.h"
#include "test_scene.h"
#include "vpl_sum.h"

namespace vsgl::test {
namespace {

constexpr const char* kTextures = "/usr/share/glmark2/textures";

struct Setting {
  const char* name;
  const char* scene;
  int rsm_size;
  int samples;       // of the reference, a pixel and strategy
  double tolerance;  // of the mean
  const char* texture_dir = "";
};
std::ostream& operator<<(std::ostream& out, const Setting& setting) {
  return out << setting.name;
}

struct Images {
  GBuffer gbuffer;
  Rsm rsm;
  Indirect chain;
  Reference truth;
};

Images render(const Setting& setting) {
  scene::GenerateOptions options;
  options.width = 48;
  options.height = 27;
  options.texture_dir = setting.texture_dir;
  const scene::Scene scene = test_scene(setting.scene, options);
  gpu::Device device({});
  Report report;
  Baker baker(scene, device, report);
  RsmParams rsm_params;
  rsm_params.width = rsm_params.height = setting.rsm_size;
  Images out{baker.gbuffer(), baker.rsm(rsm_params), {}, {}};
  const Lights lights = generate_lights(out.rsm, nullptr, {.method = "texels"}, &device, report);
  const Visibility bits =
      build_visibility({scene, lights, &out.gbuffer}, {.method = "raytraced"}, nullptr, report);
  out.chain = shade(out.gbuffer, lights, &bits, {.light_model = "vpl", .clamp = 0}, device, report);
  reference::ReferenceParams params;
  params.samples = setting.samples;
  out.truth = reference::trace_reference(scene, out.gbuffer, params, report);
  return out;
}

double radiance(const Indirect& image, std::size_t i) {
  return luminance(to_double(image.diffuse[i]) +
                   (image.specular.empty() ? Vec3{} : to_double(image.specular[i])));
}

struct Means {
  double chain = 0, truth = 0;
  double deviation = 0;  // standard deviation of `truth`; channels are taken to vary together
  std::size_t compared = 0, left_out = 0;
};

// Over the pixels where texels are close enough for the smooth integrand: elsewhere the sum over points is
// singular, or jumps over lobes.
Means means(const Images& images) {
  const std::vector<bool> far = far_from_texels(images.gbuffer, images.rsm, true);
  Means out;
  for (std::size_t i = 0; i < far.size(); ++i) {
    if (images.gbuffer.pixels[i].id == interop::NO_INSTANCE) continue;
    ++(far[i] ? out.compared : out.left_out);
    if (!far[i]) continue;
    out.chain += radiance(images.chain, i);
    out.truth += radiance(images.truth.radiance, i);
    const Vec3 v = to_double(images.truth.variance[i]);
    const double sigma = luminance({std::sqrt(v.x), std::sqrt(v.y), std::sqrt(v.z)});
    out.deviation += sigma * sigma;
  }
  const auto n = static_cast<double>(out.compared);
  return {out.chain / n, out.truth / n, std::sqrt(out.deviation) / n, out.compared, out.left_out};
}

class Agreement : public testing::TestWithParam<Setting> {};

TEST_P(Agreement, MeanRadiance) {
  const Means found = means(render(GetParam()));
  const double ratio = found.chain / found.truth, deviation = found.deviation / found.truth;
  std::printf("%-16s chain / truth %.5f, standard deviation of the truth %.5f, %zu of %zu pixels left out\n",
              GetParam().name, ratio, deviation, found.left_out, found.left_out + found.compared);
  EXPECT_NEAR(ratio, 1, GetParam().tolerance);
  EXPECT_LT(deviation, GetParam().tolerance / 2);
  EXPECT_LT(found.left_out, found.compared / 3);
}

// The atrium's own normal map is smooth, that of the textures so rough that a texel's normals face in many
// directions.
INSTANTIATE_TEST_SUITE_P(Scenes, Agreement,
                         testing::Values(Setting{"cornell", "cornell", 256, 512, 0.005},
                                         Setting{"cornell_glossy", "cornell-glossy", 256, 1024, 0.01},
                                         Setting{"caustic_ring", "caustic-ring", 256, 12000, 0.01},
                                         Setting{"atrium", "atrium", 512, 256, 0.01},
                                         Setting{"atrium_rough", "atrium", 512, 512, 0.01, kTextures}),
                         [](const auto& entry) { return std::string(entry.param.name); });

}  // namespace
}  // namespace vsgl::test
