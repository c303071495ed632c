// The visible share of each pixel's light, of a few rays: against a ray to every entry.

#include <gtest/gtest.h>
#include <omp.h>

#include "../expect_error.h"
#include "lit_room.h"
#include "stages/visibility/share_filter.h"
#include "stages/visibility/visibility.h"

namespace vsgl {
namespace {

using namespace vsgl::test;

constexpr int kWidth = 56, kHeight = 40;  // tiles cut off at both edges

// The ceiling from below, 1.8 m wide.
GBuffer ceiling() {
  std::vector<interop::Surface> pixels;
  for (int j = 0; j < kHeight; ++j)
    for (int i = 0; i < kWidth; ++i)
      pixels.push_back(
          pixel_at({1.8 * (i + 0.5) / kWidth - 0.9, 1.8 * (j + 0.5) / kHeight - 0.9, 2}, {0, 0, -1}));
  return gbuffer_of(std::move(pixels), kWidth);
}

// The room with a slab at half its height, from the wall x = -1 to x = `until`.
scene::Scene room_with_slab(double until) {
  scene::Scene scene = room();
  add_box(scene, {-1, -1, 0.98}, {until, 1, 1.02});
  return scene;
}

Cut estimate(const scene::Scene& scene, const GBuffer& gbuffer, const VisibilityParams& params = {},
             const Cut* given = nullptr) {
  VisibilityParams ratio = params;
  ratio.method = "ratio";
  Report report;
  return std::get<Cut>(
      build_visibility({scene, lit_floor(scene, 4), &gbuffer, given}, ratio, nullptr, report));
}

// The light of the cut's entries at a pixel: that which is visible, by a ray to each, and all.
struct Light {
  double visible = 0, all = 0;
};
Light light_at(const trace::Tracer& tracer, const Lights& tree, const Cut& cut, const GBuffer& gbuffer,
               int pixel) {
  const interop::Surface& receiver = gbuffer.pixels[static_cast<std::size_t>(pixel)];
  const int tile = pixel / kWidth / 16 * cut.columns() + pixel % kWidth / 16;
  const Cut::Tile& entries = cut.tiles[static_cast<std::size_t>(tile)];
  Light sum;
  for (std::uint32_t i = entries.first; i < entries.first + entries.count; ++i) {
    const interop::Light& light = tree.lights[cut.nodes[i]];
    const Vec3 v = widen(receiver.position) - widen(light.position);
    const double d2 = dot(v, v), value = static_cast<double>(light.power_diffuse.x) *
                                         dot(v, widen(light.normal)) * -dot(v, widen(receiver.normal)) /
                                         (d2 * d2);
    sum.all += value;
    if (!tracer.occluded(widen(light.origin), widen(light.normal), widen(receiver.position),
                         widen(receiver.normal)))
      sum.visible += value;
  }
  return sum;
}

TEST(Ratio, NothingInBetweenLeavesAllLight) {
  const Cut cut = estimate(room(), ceiling());
  EXPECT_EQ(cut.visibility, std::vector<float>(kWidth * kHeight, 1.0F));
  EXPECT_EQ(cut.masks, std::vector<std::uint32_t>(cut.nodes.size(), 0));
  EXPECT_EQ(cut.mask_words, std::vector<std::uint32_t>(interop::MASK_WORDS, ~0U));
  for (const Cut::Tile& tile : cut.tiles) EXPECT_GT(tile.count, 0u);
}

TEST(Ratio, AWallInBetweenLeavesNone) {
  EXPECT_EQ(estimate(room_with_slab(1), ceiling()).visibility, std::vector<float>(kWidth * kHeight, 0.0F));
}

TEST(Ratio, HalfASlabLeavesTheShareThatRaysToAllEntriesFind) {
  const scene::Scene scene = room_with_slab(0.1);
  const trace::Tracer tracer(scene);
  const Lights tree = lit_floor(scene, 4);
  const GBuffer gbuffer = ceiling();
  const auto judge = [&](int rays) {
    const Cut cut = estimate(scene, gbuffer, {.error = 0.005, .rays = rays});
    double estimated = 0, visible = 0, squared = 0;
    for (int pixel = 0; pixel < kWidth * kHeight; ++pixel) {
      const Light light = light_at(tracer, tree, cut, gbuffer, pixel);
      const double share = light.visible / light.all,
                   found = static_cast<double>(cut.visibility[static_cast<std::size_t>(pixel)]);
      estimated += found * light.all;
      visible += light.visible;
      squared += (found - share) * (found - share);
    }
    EXPECT_NEAR(estimated / visible, 1, 0.01) << rays;  // 0.001 seen
    return std::sqrt(squared / (kWidth * kHeight));
  };
  EXPECT_LT(judge(4), 0.03);
  EXPECT_LT(judge(16), 0.02);
}

TEST(Ratio, SeedsDifferButThreadsDoNot) {
  const scene::Scene scene = furnished_room();
  const GBuffer gbuffer = look_into(scene, kWidth, kHeight);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Cut one = estimate(scene, gbuffer);
  omp_set_num_threads(2);
  const Cut two = estimate(scene, gbuffer);
  omp_set_num_threads(before);
  EXPECT_EQ(one.nodes, two.nodes);
  EXPECT_EQ(one.visibility, two.visibility);
  const Cut other = estimate(scene, gbuffer, {.seed = 1});
  EXPECT_EQ(other.nodes, one.nodes);
  EXPECT_NE(other.visibility, one.visibility);
}

// Black pixels take the share of those beside them; alone, and in the background, they have 1.
TEST(Ratio, PixelsWithoutLightHaveAShare) {
  const scene::Scene scene = room_with_slab(1);
  GBuffer gbuffer = ceiling();
  gbuffer.pixels[5 * kWidth + 20].diffuse = {};
  gbuffer.pixels[5 * kWidth + 21].id = interop::NO_INSTANCE;
  std::vector<float> expected(kWidth * kHeight, 0.0F);
  expected[5 * kWidth + 21] = 1;
  EXPECT_EQ(estimate(scene, gbuffer).visibility, expected);
  for (interop::Surface& pixel : gbuffer.pixels) pixel.diffuse = {};
  EXPECT_EQ(estimate(scene, gbuffer).visibility, std::vector<float>(kWidth * kHeight, 1.0F));
  for (interop::Surface& pixel : gbuffer.pixels) pixel.id = interop::NO_INSTANCE;
  const Cut cut = estimate(scene, gbuffer);
  EXPECT_EQ(cut.visibility, std::vector<float>(kWidth * kHeight, 1.0F));
  EXPECT_TRUE(cut.nodes.empty());
}

TEST(Ratio, KeepsTheEntriesOfAGivenCut) {
  const scene::Scene scene = furnished_room();
  const GBuffer gbuffer = look_into(scene, kWidth, kHeight);
  Report report;
  const Cut given = std::get<Cut>(build_visibility({scene, lit_floor(scene, 4), &gbuffer},
                                                   {.method = "rays", .error = 0.1}, nullptr, report));
  const Cut cut = estimate(scene, gbuffer, {}, &given);
  EXPECT_EQ(cut.nodes, given.nodes);
  EXPECT_EQ(cut.masks, std::vector<std::uint32_t>(given.nodes.size(), 0));
  EXPECT_EQ(cut.mask_words, std::vector<std::uint32_t>(interop::MASK_WORDS, ~0U));
}

TEST(Ratio, TracesNoMoreRaysThanAsked) {
  const scene::Scene scene = room();
  const GBuffer gbuffer = ceiling();
  for (const int rays : {1, 7}) {
    Report report;
    build_visibility({scene, lit_floor(scene, 4), &gbuffer}, {.method = "ratio", .rays = rays}, nullptr,
                     report);
    EXPECT_EQ(report.to_json()["counts"]["rays"], rays * kWidth * kHeight);
  }
  expect_error(ErrorCode::out_of_range, {"rays", "1..64"}, [&] { estimate(scene, gbuffer, {.rays = 0}); });
}

TEST(Ratio, IsWhatAutoChoosesForManyTriangles) {
  scene::Scene scene = room();
  const Lights tree = lit_floor(scene, 2);
  const auto choose = [&] { return choose_visibility({scene, tree}, {}); };
  auto& indices = scene.instances.front().indices;
  indices.resize(3 * 400'000);
  EXPECT_EQ(choose().method.name, "rays");
  EXPECT_NE(choose().reason.find("400000 triangles are at most"), std::string::npos);
  indices.resize(3 * 400'001);
  EXPECT_EQ(choose().method.name, "ratio");
  EXPECT_NE(choose().reason.find("400001 triangles are more than 400000"), std::string::npos);
}

// ---- The filter

TEST(ShareFilter, IsATentThatAddsUpToOne) {
  const GBuffer gbuffer = ceiling();
  std::vector<float> shares(kWidth * kHeight);
  shares[20 * kWidth + 30] = 1;
  const std::vector<float> spread = visibility::filter_shares(gbuffer, shares);
  EXPECT_NEAR(spread[20 * kWidth + 30], 1 / 16.0, 1e-6);
  EXPECT_NEAR(spread[20 * kWidth + 33], 1 / 64.0, 1e-6);
  double sum = 0, x = 0, y = 0;
  for (int pixel = 0; pixel < kWidth * kHeight; ++pixel) {
    const double share = static_cast<double>(spread[static_cast<std::size_t>(pixel)]);
    sum += share;
    x += share * (pixel % kWidth);
    y += share * (pixel / kWidth);
  }
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_NEAR(x, 30, 1e-4);
  EXPECT_NEAR(y, 20, 1e-4);
}

// A corner between two walls, and a step in depth.
TEST(ShareFilter, StopsAtEdges) {
  std::vector<interop::Surface> pixels;
  std::vector<float> shares;
  for (int i = 0; i < 48 * 16; ++i) {
    const double x = 0.1 * (i % 48), y = 0.1 * (i / 48);
    if (i % 48 < 16)
      pixels.push_back(pixel_at({x, y, 0}, {0, 0, 1}));
    else if (i % 48 < 32)
      pixels.push_back(pixel_at({1.6, y, x - 1.6}, {-1, 0, 0}));
    else
      pixels.push_back(pixel_at({x, y, 8}, {-1, 0, 0}));
    shares.push_back(i % 48 < 16 || i % 48 >= 32 ? 0.25F : 0.75F);
  }
  EXPECT_EQ(visibility::filter_shares(gbuffer_of(std::move(pixels), 48), shares), shares);
}

TEST(ShareFilter, FillsWhatIsNotKnown) {
  const GBuffer gbuffer = ceiling();
  std::vector<float> shares(kWidth * kHeight, visibility::kNoShare);
  shares[0] = 0.5F;
  const std::vector<float> filled = visibility::filter_shares(gbuffer, shares);
  EXPECT_EQ(filled[3 * kWidth + 3], 0.5F);
  EXPECT_EQ(filled[3 * kWidth + 4], 1.0F);
}

}  // namespace
}  // namespace vsgl
