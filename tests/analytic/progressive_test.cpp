// Progressive rendering: point and sphere lights converge to the ground truth. VSGLs, whose lobes are
// approximations, tend to the sum over all texels as VSGLs, and slowly: their error falls little with their
// size.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "math/interop_vec.h"
#include "pipeline/renderer.h"
#include "reference/reference.h"
#include "test_scene.h"

namespace vsgl::test {
namespace {

constexpr int kWidth = 24, kHeight = 16;

struct Setting {
  const char* name;
  const char* method;
  const char* light_model;
  bool exact;  // the truth is the limit
};
std::ostream& operator<<(std::ostream& out, const Setting& setting) {
  return out << setting.name;
}

const scene::Scene& glossy_box() {
  static const scene::Scene scene = test_scene("cornell-glossy", kWidth, kHeight);
  return scene;
}

Pipeline pipeline_of(const Setting& setting) {
  Pipeline pipeline;
  pipeline.rsm_bake.rsm.width = pipeline.rsm_bake.rsm.height = 256;
  pipeline.pdf_build.method = "flux";
  pipeline.vsgl_gen.method = setting.method;
  pipeline.vsgl_gen.count = 64;
  pipeline.ismap->method = "raytraced";
  pipeline.shade.light_model = setting.light_model;
  pipeline.shade.vsl_samples = 8;
  return pipeline;
}

RenderedFrame render(gpu::Device& device, const Setting& setting, int passes, std::uint64_t seed) {
  Pipeline pipeline = pipeline_of(setting);
  pipeline.progressive = Progressive{.passes = passes};
  pipeline.set_seed(seed);
  return Renderer(device, pipeline, false).render(glossy_box());
}

const Reference& truth(const GBuffer& gbuffer) {
  static const Reference image = [&] {
    Report report;
    reference::ReferenceParams params;
    params.samples = 2048;
    return reference::trace_reference(glossy_box(), gbuffer, params, report);
  }();
  return image;
}

double radiance(const Indirect& image, std::size_t i) {
  return luminance(to_double(image.diffuse[i]) +
                   (image.specular.empty() ? Vec3{} : to_double(image.specular[i])));
}

// What the passes tend to.
Indirect limit_of(gpu::Device& device, const Setting& setting) {
  Pipeline pipeline = pipeline_of(setting);
  pipeline.vsgl_gen.method = "texels";
  const RenderedFrame frame = Renderer(device, pipeline, false).render(glossy_box());
  return setting.exact ? truth(frame.gbuffer).radiance : frame.image;
}

// Mean squared relative error of luminance.
double error_of(const RenderedFrame& frame, const Indirect& limit) {
  double sum = 0, mean = 0;
  for (std::size_t i = 0; i < frame.gbuffer.pixels.size(); ++i)
    mean += radiance(limit, i) / static_cast<double>(frame.gbuffer.pixels.size());
  for (std::size_t i = 0; i < frame.gbuffer.pixels.size(); ++i) {
    const double wanted = radiance(limit, i), floor = 0.02 * mean;
    sum += std::pow(radiance(frame.image, i) - wanted, 2) / (wanted * wanted + floor * floor);
  }
  return sum / static_cast<double>(frame.gbuffer.pixels.size());
}

class ProgressiveTest : public testing::TestWithParam<Setting> {};

// Variance and squared bias of the mean of n passes fall as n^(-2/3) at least: by 16 from 1 to 64.
TEST_P(ProgressiveTest, Converges) {
  gpu::Device device({.compute_only = true});
  const Indirect limit = limit_of(device, GetParam());
  double one = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed)
    one += error_of(render(device, GetParam(), 1, seed), limit) / 4;
  const double eight = error_of(render(device, GetParam(), 8, 0), limit);
  const double many = error_of(render(device, GetParam(), 64, 0), limit);
  std::printf("%-8s relMSE of 1, 8 and 64 passes: %.4f %.4f %.4f\n", GetParam().name, one, eight, many);
  EXPECT_LT(eight, (GetParam().exact ? 0.5 : 0.9) * one);
  EXPECT_LT(many, (GetParam().exact ? 0.5 : 0.9) * eight);
}

INSTANTIATE_TEST_SUITE_P(Methods, ProgressiveTest,
                         testing::Values(Setting{"vsl", "vsl", "vsl", true},
                                         Setting{"vsgl", "fis-2016", "vsgl", false},
                                         Setting{"vsgl_2014", "fis-2014", "vsgl-2014", false},
                                         Setting{"vpl", "vpl", "vpl", true}),
                         [](const auto& entry) { return std::string(entry.param.name); });

}  // namespace
}  // namespace vsgl::test
