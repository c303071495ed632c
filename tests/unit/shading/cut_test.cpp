// Shading by a cut at full resolution: against sums in double precision, masks, borders, determinism.

#include <omp.h>

#include <cstring>

#include "cut_scene.h"
#include "stages/shading/cut_pass.h"
#include "stages/shading/cut_pixels.h"

namespace vsgl {
namespace {

using test::BoxOptions;

constexpr ShadingParams kExact{.diffuse_scale = 1};

BoxOptions options(std::uint32_t receiver, std::uint32_t emission, double sigma) {
  BoxOptions out;
  out.width = 37;
  out.height = 21;
  out.lights = 150;
  out.receiver_ndf = receiver;
  out.emission_ndf = emission;
  out.sigma = sigma;
  return out;
}

// Lights of all kinds: with and without specular emission, of parallel and of spread normals.
Lights mixed_lights(const BoxOptions& options) {
  Lights lights = test::box_lights(options);
  lights.method = "tree";
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    interop::Light& light = lights.lights[i];
    if (i % 3 == 0) light.normal_deficit = 0.1f * static_cast<float>(i % 5);
    if (i % 2 == 0) light.power_specular = {};
    light.lobe_variance = 0.01f * static_cast<float>(i % 4);
  }
  return lights;
}

// One pixel a tile, so that a block decides for one pixel what is like a point; elsewhere nothing is seen.
GBuffer sparse_gbuffer(const BoxOptions& options) {
  GBuffer gbuffer = test::box_gbuffer(options);
  for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
    const int x = static_cast<int>(i) % options.width % 16, y = static_cast<int>(i) / options.width % 16;
    if (x != 3 || y != 2) gbuffer.pixels[i] = test::background();
  }
  return gbuffer;
}

void expect_sum(const GBuffer& gbuffer, const Lights& lights, const Cut& cut, double tolerance) {
  const std::vector<interop::Cluster> clusters = pack_clusters(lights);
  test::expect_near_oracle(
      test::shade_by(cut, gbuffer, lights, kExact),
      [&](std::size_t i) { return test::cut_sum(gbuffer, i, clusters, cut); }, tolerance);
}

class Kinds : public testing::TestWithParam<std::pair<std::uint32_t, std::uint32_t>> {
 protected:
  BoxOptions box(double sigma) const { return options(GetParam().first, GetParam().second, sigma); }
};
INSTANTIATE_TEST_SUITE_P(OfReceiverAndEmission, Kinds,
                         testing::Values(std::pair{interop::NDF_NONE, interop::NDF_NONE},
                                         std::pair{interop::NDF_NONE, interop::NDF_GGX},
                                         std::pair{interop::NDF_GGX, interop::NDF_NONE},
                                         std::pair{interop::NDF_GGX, interop::NDF_GGX},
                                         std::pair{interop::NDF_BECKMANN, interop::NDF_PHONG}));

TEST_P(Kinds, SumPoints) {
  const GBuffer gbuffer = sparse_gbuffer(box(0.01));
  const Lights lights = mixed_lights(box(0.01));
  expect_sum(gbuffer, lights, test::whole_cut(gbuffer, lights), 2e-4);
}

TEST_P(Kinds, SumFootprints) {
  const GBuffer gbuffer = test::box_gbuffer(box(0.5));
  const Lights lights = mixed_lights(box(0.5));
  expect_sum(gbuffer, lights, test::whole_cut(gbuffer, lights), 1e-3);
}

TEST(Cut, RespectsEveryBitOfAMask) {
  const BoxOptions box = options(interop::NDF_NONE, interop::NDF_NONE, 0.5);
  const GBuffer gbuffer = test::box_gbuffer(box);
  const Lights lights = mixed_lights(box);
  Cut cut = test::whole_cut(gbuffer, lights);
  test::Uniform uniform;
  test::add_masks(cut, [&](std::size_t, std::uint32_t, std::uint32_t) { return uniform() < 0.5; });
  expect_sum(gbuffer, lights, cut, 1e-3);
}

TEST(Cut, OfTilesAtTheBordersOfAnyImage) {
  for (const auto& [width, height] : {std::pair{1, 1}, {16, 16}, {17, 33}, {5, 47}}) {
    SCOPED_TRACE(testing::Message() << width << "x" << height);
    BoxOptions box = options(interop::NDF_NONE, interop::NDF_NONE, 0.5);
    box.width = width;
    box.height = height;
    const GBuffer gbuffer = test::box_gbuffer(box);
    const Lights lights = mixed_lights(box);
    expect_sum(gbuffer, lights, test::whole_cut(gbuffer, lights), 1e-3);
  }
}

}  // namespace
}  // namespace vsgl
