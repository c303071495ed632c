// The chain without visibility against brute force: every RSM texel as a point light, summed in double
// precision.

#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <memory>

#include "stages/lights/lights.h"
#include "stages/pdf/pdf.h"
#include "stages/rsm/rsm.h"
#include "stages/shading/shading.h"
#include "test_scene.h"
#include "vpl_sum.h"

namespace vsgl::test {
namespace {

gpu::Device& device() {
  static gpu::Device instance({});
  return instance;
}

// A scene as the chain sees it: buffers, and the brute-force truth.
struct Baked {
  GBuffer gbuffer;
  Rsm rsm;
  VplSum truth;
};

Baked bake(const std::string& name, int width, int height, int rsm_size) {
  Report report;
  const scene::Scene scene = test_scene(name, width, height);
  RsmParams params;
  params.width = params.height = rsm_size;
  Baked out{bake_gbuffer(scene, device(), report), bake_rsm(scene, params, device(), report), {}};
  out.truth = vpl_sum(out.gbuffer, out.rsm);
  return out;
}

const Baked& baked(const std::string& name) {
  static std::map<std::string, Baked> cache;
  const auto found = cache.find(name);
  return found != cache.end() ? found->second : cache.emplace(name, bake(name, 96, 54, 128)).first->second;
}

Pdf pdf_of(const Baked& scene, const std::string& method) {
  Report report;
  PdfParams params;
  params.method = method;
  return build_pdf(scene.rsm, &scene.gbuffer, params, device(), report);
}

Lights lights_of(const Baked& scene, const Pdf& pdf, const std::string& method, int count) {
  Report report;
  LightsParams params;
  params.method = method;
  params.count = count;
  return generate_lights(scene.rsm, &pdf, params, &device(), report);
}

Agreement shaded(const Baked& scene, const Lights& lights, const ShadingParams& params) {
  Report report;
  return agreement(shade(scene.gbuffer, lights, nullptr, params, device(), report), scene.truth);
}

struct Variant {
  const char* name;
  const char* lights;
  ShadingParams shading;
};

std::vector<Variant> variants() {
  ShadingParams vsgl, uncancelled, formulation_a, vpl;
  vsgl.light_model = uncancelled.light_model = "vsgl";
  uncancelled.cbr = 0;
  formulation_a.light_model = "vsgl-2014";
  vpl.light_model = "vpl";
  return {{"fis-2016, vsgl", "fis-2016", vsgl},
          {"fis-2016, vsgl, cbr 0", "fis-2016", uncancelled},
          {"fis-2016, vsgl-2014", "fis-2016", formulation_a},
          {"fis-2014, vsgl", "fis-2014", vsgl},
          {"vpl, clamped", "vpl", vpl}};
}

// Prints the table of a scene and returns mean ratio and relMSE of fis-2016 + vsgl per number of lights.
std::map<int, Agreement> table(const std::string& name) {
  const Baked& scene = baked(name);
  const Pdf pdf = pdf_of(scene, "brsm-vsgl");
  std::map<int, Agreement> main_row;
  std::printf("%s: %zu of %zu pixels left out\n%-24s", name.c_str(), scene.truth.left_out,
              scene.truth.compared.size(), "mean / relMSE, N =");
  for (const int count : {64, 256, 1024, 4096}) std::printf("%20d", count);
  for (const Variant& variant : variants()) {
    std::printf("\n%-24s", variant.name);
    for (const int count : {64, 256, 1024, 4096}) {
      const Agreement found = shaded(scene, lights_of(scene, pdf, variant.lights, count), variant.shading);
      std::printf("   %7.4f %9.2e", found.mean_ratio, found.relative_mse);
      main_row.try_emplace(count, found);
    }
  }
  std::printf("\n");
  return main_row;
}

void expect_falling(const std::map<int, Agreement>& row) {
  EXPECT_LT(row.at(256).relative_mse, row.at(64).relative_mse);
  EXPECT_LT(row.at(1024).relative_mse, row.at(256).relative_mse);
  EXPECT_LT(row.at(4096).relative_mse, row.at(1024).relative_mse);
}

TEST(BruteForce, Cornell) {
  const auto row = table("cornell");
  EXPECT_NEAR(row.at(1024).mean_ratio, 1, 0.02);
  expect_falling(row);
}

TEST(BruteForce, CornellGlossy) {
  const auto row = table("cornell-glossy");
  EXPECT_NEAR(row.at(1024).mean_ratio, 1, 0.05);
  expect_falling(row);
}

TEST(BruteForce, EmittedPowerIsTheReflectedPower) {
  for (const char* name : {"cornell", "cornell-glossy"})
    for (const char* method : {"uniform", "flux", "brsm-vpl", "brsm-vsgl"}) {
      const Baked& scene = baked(name);
      const Lights lights = lights_of(scene, pdf_of(scene, method), "fis-2016", 1024);
      const double ratio = emitted_power(lights) / reflected_power(scene.rsm);
      std::printf("%-16s%-12s emitted / reflected power %.5f\n", name, method, ratio);
      EXPECT_NEAR(ratio, 1, 0.005) << name << " " << method;
    }
}

// One light per texel: with bias reduction both formulations tend to the VPL sum as the RSM is refined.
TEST(BruteForce, ConsistentBiasReduction) {
  for (const char* method : {"vsgl", "vsgl-2014"}) {
    Agreement previous{0, 1e30};
    double cancelled = 0;
    for (const int size : {128, 256, 512}) {
      const Baked scene = bake("cornell-glossy", 32, 18, size);
      ShadingParams params;
      params.light_model = method;
      Report report;
      const Lights texels = generate_lights(scene.rsm, nullptr, {.method = "texels"}, &device(), report);
      const Indirect image = shade(scene.gbuffer, texels, nullptr, params, device(), report);
      const Agreement found = agreement(image, scene.truth);
      double sum = 0;
      for (std::size_t i = 0; i < image.cancellation.size(); ++i)
        if (scene.truth.compared[i]) sum += static_cast<double>(image.cancellation[i]);
      const double mean = sum / static_cast<double>(std::count(scene.truth.compared.begin(),
                                                               scene.truth.compared.end(), true));
      std::printf("%-10s RSM %4d: mean %.5f relMSE %.3e cancelled %.5f\n", method, size, found.mean_ratio,
                  found.relative_mse, mean);
      EXPECT_LT(found.relative_mse, previous.relative_mse);
      EXPECT_GT(mean, cancelled);
      previous = found;
      cancelled = mean;
    }
    EXPECT_GT(cancelled, 0.98);
  }
}

}  // namespace
}  // namespace vsgl::test
