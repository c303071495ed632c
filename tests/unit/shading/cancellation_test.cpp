// Consistent bias reduction.

#include "run.h"

namespace vsgl {
namespace {

using test::BoxOptions;

constexpr std::uint32_t kNdfs[] = {interop::NDF_NONE, interop::NDF_GGX, interop::NDF_BECKMANN,
                                   interop::NDF_PHONG};

BoxOptions box(std::uint32_t ndf, double sigma) {
  BoxOptions options;
  options.receiver_ndf = options.emission_ndf = ndf;
  options.sigma = sigma;
  return options;
}

// Where the footprints are tiny both formulations are the sum of exact paths.
TEST(Cancellation, TendsToTheSumOfExactPaths) {
  for (const char* method : {"vsgl", "vsgl-2014"})
    for (std::uint32_t ndf : kNdfs) {
      SCOPED_TRACE(testing::Message() << method << " " << ndf);
      const BoxOptions options = box(ndf, 1e-5);
      const GBuffer gbuffer = test::box_gbuffer(options);
      const Lights lights = test::box_lights(options);
      const Indirect image = test::shade_box(gbuffer, lights, {.light_model = method, .cbr = 0.05});
      test::expect_near_oracle(
          image, [&](std::size_t i) { return test::vpl_sum(gbuffer, i, lights); }, 2e-5);
      for (float share : image.cancellation) EXPECT_GT(share, 0.9999f);
    }
}

// At a threshold that some lights pass and some do not.
TEST(Cancellation, BlendsByTheRatioOfSharpnesses) {
  for (const char* method : {"vsgl", "vsgl-2014"})
    for (std::uint32_t ndf : kNdfs) {
      SCOPED_TRACE(testing::Message() << method << " " << ndf);
      const BoxOptions options = box(ndf, 0.05);
      const GBuffer gbuffer = test::box_gbuffer(options);
      const Lights lights = test::box_lights(options);
      const ShadingParams params{.light_model = method, .cbr = 0.2};
      const Indirect image = test::shade_box(gbuffer, lights, params);
      const auto oracle = [&](std::size_t i) {
        return test::vsgl_sum(gbuffer, i, lights, params.light_model == "vsgl-2014", {.cbr = params.cbr});
      };
      test::expect_near_oracle(image, oracle, 2e-4);
      int partly = 0;
      for (std::size_t i = 0; i < image.cancellation.size(); ++i) {
        const test::Radiance expected = oracle(i);
        const double share = expected.cancelled / luminance(expected.diffuse + expected.specular);
        EXPECT_NEAR(image.cancellation[i], share, 0.02) << i;
        partly += share > 0.01 && share < 0.99;
      }
      EXPECT_TRUE(partly > 10 || params.light_model == "vsgl-2014") << partly;
    }
}

TEST(Cancellation, IsOffAtThresholdZero) {
  const BoxOptions options = box(interop::NDF_GGX, 1e-5);
  const GBuffer gbuffer = test::box_gbuffer(options);
  const Lights lights = test::box_lights(options);
  const Indirect image = test::shade_box(gbuffer, lights, {.light_model = "vsgl", .cbr = 0});
  EXPECT_TRUE(image.cancellation.empty());
  test::expect_near_oracle(
      image, [&](std::size_t i) { return test::vsgl_sum(gbuffer, i, lights, false); }, 2e-4);
}

// A cluster whose representative point has no specular lobe keeps its spherical Gaussian.
TEST(Cancellation, LeavesLightsWithoutABrdfAlone) {
  const BoxOptions options = box(interop::NDF_GGX, 1e-4);
  const GBuffer gbuffer = test::box_gbuffer(options);
  Lights lights = test::box_lights(options);
  for (auto& light : lights.lights) light.ndf = interop::NDF_NONE;
  const Indirect image = test::shade_box(gbuffer, lights, {.light_model = "vsgl", .cbr = 1});
  for (float share : image.cancellation) EXPECT_EQ(share, 0.0f);
}

}  // namespace
}  // namespace vsgl
