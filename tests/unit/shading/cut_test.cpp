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
    light.normal_deficit = i % 3 == 0 ? 0.1f * static_cast<float>(i % 5) : 0;
    if (i % 2 == 0) light.power_specular = {};
    light.lobe_variance = 0.01f * static_cast<float>(i % 4);
    light.shading_deficit = 0.005f * static_cast<float>(i % 4);
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
  const std::vector<test::Box> boxes = test::block_boxes(gbuffer);
  test::expect_near_oracle(
      test::shade_by(cut, gbuffer, lights, kExact),
      [&](std::size_t i) { return test::cut_sum(gbuffer, i, clusters, cut, boxes[i]); }, tolerance);
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
  const GBuffer gbuffer = sparse_gbuffer(box(1e-3));
  const Lights lights = mixed_lights(box(1e-3));
  expect_sum(gbuffer, lights, test::whole_cut(gbuffer, lights), 2e-4);
}

// Far clusters' highlights are spread without the horizon of the extended form.
TEST_P(Kinds, SumFarFootprints) {
  const GBuffer gbuffer = sparse_gbuffer(box(0.02));
  const Lights lights = mixed_lights(box(0.02));
  expect_sum(gbuffer, lights, test::whole_cut(gbuffer, lights), 3e-2);
}

TEST_P(Kinds, SumFootprints) {
  const GBuffer gbuffer = test::box_gbuffer(box(0.5));
  const Lights lights = mixed_lights(box(0.5));
  expect_sum(gbuffer, lights, test::whole_cut(gbuffer, lights), 4e-3);
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

TEST(Cut, WithoutEntriesGivesBlack) {
  const BoxOptions box = options(interop::NDF_NONE, interop::NDF_NONE, 0.1);
  const GBuffer gbuffer = test::box_gbuffer(box);
  Lights lights = mixed_lights(box);
  Cut cut = test::whole_cut(gbuffer, lights);
  for (Cut::Tile& tile : cut.tiles) tile.first = tile.count = 0;
  cut.nodes.clear();
  for (const int scale : {1, 2}) {
    const Indirect image = test::shade_by(cut, gbuffer, lights, {.diffuse_scale = scale});
    for (const interop::vec3 c : image.diffuse) EXPECT_EQ(c.x + c.y + c.z, 0);
  }
}

TEST(Cut, TellsItsSizeAndError) {
  const BoxOptions box = options(interop::NDF_NONE, interop::NDF_NONE, 0.1);
  GBuffer gbuffer = test::box_gbuffer(box);
  gbuffer.pixels[0] = test::background();
  const Lights lights = mixed_lights(box);
  Cut cut = test::whole_cut(gbuffer, lights);
  cut.tiles[1].error = 0.25f;
  const Indirect image = test::shade_by(cut, gbuffer, lights);
  EXPECT_EQ(image.cut_size[0], 0);  // background
  EXPECT_EQ(image.cut_size[1], 150);
  EXPECT_FLOAT_EQ(image.error_estimate[1], 0.01f);
  EXPECT_FLOAT_EQ(image.error_estimate[16], 0.25f);
}

TEST(Cut, IsMultipliedByTheGainsOfItsTiles) {
  const BoxOptions box = options(interop::NDF_GGX, interop::NDF_NONE, 0.1);
  const GBuffer gbuffer = test::box_gbuffer(box);
  const Lights lights = mixed_lights(box);
  Cut cut = test::whole_cut(gbuffer, lights);
  const Indirect plain = test::shade_by(cut, gbuffer, lights, kExact);
  for (std::size_t k = 0; k < Cut::kRing; ++k) cut.tiles[1].gain[k] = 0.8f + 0.02f * static_cast<float>(k);
  const Indirect image = test::shade_by(cut, gbuffer, lights, kExact);
  for (std::uint32_t i = 0; i < plain.diffuse.size(); ++i) {
    const float gain = gain_at(gbuffer, cut, i);
    EXPECT_NEAR(image.diffuse[i].x, gain * plain.diffuse[i].x, 1e-6f * plain.diffuse[i].x);
    EXPECT_NEAR(image.specular[i].y, gain * plain.specular[i].y, 1e-6f * plain.specular[i].y);
  }
  EXPECT_FLOAT_EQ(gain_at(gbuffer, cut, 16), 0.8f);
  EXPECT_EQ(gain_at(gbuffer, cut, 15), 1);
}

TEST(Cut, IsMultipliedByTheVisibleShare) {
  const BoxOptions box = options(interop::NDF_GGX, interop::NDF_NONE, 0.1);
  const GBuffer gbuffer = test::box_gbuffer(box);
  const Lights lights = mixed_lights(box);
  Cut cut = test::whole_cut(gbuffer, lights);
  test::add_masks(cut, [](std::size_t, std::uint32_t, std::uint32_t) { return true; });
  const Indirect open = test::shade_by(cut, gbuffer, lights);
  cut.visibility.assign(gbuffer.pixels.size(), 0.25f);
  const Indirect shaded = test::shade_by(cut, gbuffer, lights);
  for (std::size_t i = 0; i < open.diffuse.size(); ++i) {
    EXPECT_FLOAT_EQ(shaded.diffuse[i].x, 0.25f * open.diffuse[i].x);
    EXPECT_FLOAT_EQ(shaded.specular[i].y, 0.25f * open.specular[i].y);
  }
}

// Pixels of every kind, some of them background, and masks.
struct Mixture {
  GBuffer gbuffer;
  Lights lights;
  Cut cut;

  Mixture() {
    BoxOptions box = options(interop::NDF_GGX, interop::NDF_GGX, 0.1);
    box.tilt = 0.1;
    gbuffer = test::box_gbuffer(box);
    for (std::size_t i = 0; i < gbuffer.pixels.size(); ++i) {
      interop::Surface& s = gbuffer.pixels[i];
      s.ndf = static_cast<std::uint32_t>(i / 9 % 4);
      if (s.ndf == interop::NDF_NONE) s.specular = {};
      if (i % 11 == 0) s = test::background();
    }
    lights = mixed_lights(box);
    cut = test::whole_cut(gbuffer, lights);
    test::Uniform uniform;
    test::add_masks(
        cut, [&](std::size_t e, std::uint32_t, std::uint32_t) { return e % 7 != 0 && uniform() < 0.7; });
  }
};

TEST(Cut, AgreesWithTheGeneralPipeline) {
  const Mixture m;
  for (const int scale : {1, 2}) {
    Report report;
    const Indirect special = test::shade_by(m.cut, m.gbuffer, m.lights, {.diffuse_scale = scale}, &report);
    const Indirect general =
        test::shade_by(m.cut, m.gbuffer, m.lights, {.diffuse_scale = scale, .skip = false});
    EXPECT_LT(test::difference(special.diffuse, general.diffuse), 2e-6);
    EXPECT_LT(test::difference(special.specular, general.specular), 2e-6);
    const std::string skipped = report.to_json()["skipped"].dump();
    EXPECT_NE(skipped.find("occluded clusters"), std::string::npos) << skipped;
    EXPECT_NE(skipped.find("background"), std::string::npos) << skipped;
  }
}

bool same_bytes(const std::vector<interop::vec3>& a, const std::vector<interop::vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(interop::vec3)) == 0;
}

TEST(Cut, GivesTheSameBytesForAnyNumberOfThreads) {
  const Mixture m;
  Indirect images[2];
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2}) {
    omp_set_num_threads(threads);
    gpu::Device device({.threads = threads, .compute_only = true});
    Report report;
    images[threads - 1] = shade_cut(m.gbuffer, m.lights, m.cut, {}, device, report);
  }
  omp_set_num_threads(before);
  EXPECT_TRUE(same_bytes(images[0].diffuse, images[1].diffuse));
  EXPECT_TRUE(same_bytes(images[0].specular, images[1].specular));
}

TEST(Cut, GivesTheSameBytesInPieces) {
  const Mixture m;
  const std::vector<std::uint8_t> kinds = pixel_kinds(m.gbuffer), all(kinds.size(), 1);
  const CutClusters clusters = gather_clusters(m.lights, m.cut);
  CutPass pass(m.gbuffer, m.cut, clusters, false, test::shared_device());
  std::vector<std::uint8_t> seen = all;
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = kinds[i] != kBackground;
  for (const CutReceivers& receivers : sort_into_blocks(m.gbuffer, kinds, seen, false)) {
    Report report;
    const auto whole = pass.run(receivers, CutPass::kWords, report), pieces = pass.run(receivers, 1, report);
    ASSERT_EQ(whole.size(), receivers.pixels.size());
    ASSERT_EQ(pieces.size(), whole.size());
    EXPECT_EQ(std::memcmp(whole.data(), pieces.data(), whole.size() * sizeof(interop::CutSums)), 0);
  }
}

}  // namespace
}  // namespace vsgl
