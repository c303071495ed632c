// [Heitz 2018b] Shadows as the visible share of each pixel's light: a few rays, to entries of the cut drawn
// by the light that they would give. docs/visibility.md describes it. Deviation: the light without shadows is
// that of the cut, and the share is one number for all of it.

#include "stages/visibility/ratio.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <span>

#include "cluster/cluster.h"
#include "cluster/evaluate.h"
#include "math/sampling.h"
#include "stages/visibility/ray_sight.h"
#include "stages/visibility/share_filter.h"

namespace vsgl::visibility {
namespace {

static_assert(kTileSamples <= kMaxPairs);

// Pixels a side of a block, whose light is evaluated at once.
constexpr int kBlock = 4;
static_assert(kBlock * kBlock == kTileSamples);
constexpr std::size_t kBlocks = interop::TILE / kBlock * (interop::TILE / kBlock);  // of a tile

// The pixels of a block that are no background.
TileSamples pixels_of(const GBuffer& gbuffer, const Cut& cut, std::size_t tile, std::size_t block) {
  constexpr int kSide = static_cast<int>(interop::TILE), kRow = kSide / kBlock;
  const int number = static_cast<int>(tile), place = static_cast<int>(block);
  return block_pixels(gbuffer, number % cut.columns() * kSide + place % kRow * kBlock,
                      number / cut.columns() * kSide + place / kRow * kBlock);
}

// Where between two strata's borders a pixel's rays fall, [0,1): in a window of 8x8 pixels, wherever it is,
// the 64 ranks of an ordered-dither matrix are each taken once, and jittered by a hash.
double stratum_offset(std::uint32_t x, std::uint32_t y, std::uint32_t pixel, std::uint64_t seed) {
  std::uint32_t rank = 0;
  for (std::uint32_t bit = 0; bit < 3; ++bit) {
    const std::uint32_t px = x >> bit & 1U, py = y >> bit & 1U;
    rank = 4 * rank + (2 * (px ^ py) + py);
  }
  const auto hash = pcg3d({pixel, static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  return (rank + 0x1p-32 * hash[0]) / 64;
}

// Draws entries for the pixels of one tile, and traces rays to them.
class TileRays {
 public:
  TileRays(const GBuffer& gbuffer, std::span<const std::uint32_t> nodes,
           std::span<const interop::Cluster> clusters, const Sight& sight, const VisibilityParams& params)
      : gbuffer_(gbuffer), nodes_(nodes), sight_(sight), params_(params), light_up_to_(nodes.size()) {
    for (const std::uint32_t node : nodes) clusters_.push_back(clusters[node]);
  }

  // Writes the shares of the block's pixels that some entry lights; returns the number of rays.
  std::size_t trace(const TileSamples& block, std::span<float> shares) {
    evaluate_all(sample_receivers(gbuffer_, block));
    std::array<int, kTileSamples> seen{};
    std::size_t rays = 0;
    for (int ray = 0; ray < params_.rays; ++ray) {
      std::array<Pair, kTileSamples> pairs;
      std::array<std::size_t, kTileSamples> lanes;
      std::size_t count = 0;
      for (std::size_t lane = 0; lane < kTileSamples; ++lane) {
        if ((block.present >> lane & 1U) == 0 || !(light_up_to_.back()[lane] > 0)) continue;
        lanes[count] = lane;
        pairs[count++] = {draw(lane, ray, block.pixel[lane]), block.pixel[lane]};
      }
      const Seen answer = sight_.see(std::span(pairs).first(count));
      for (std::size_t i = 0; i < count; ++i) seen[lanes[i]] += static_cast<int>(answer.visible >> i & 1U);
      rays += static_cast<std::size_t>(std::popcount(answer.facing));
    }
    for (std::size_t lane = 0; lane < kTileSamples; ++lane)
      if ((block.present >> lane & 1U) != 0 && light_up_to_.back()[lane] > 0)
        shares[block.pixel[lane]] = static_cast<float>(seen[lane]) / static_cast<float>(params_.rays);
    return rays;
  }

 private:
  void evaluate_all(const SampleReceivers& receivers) {
    ClusterLight light;
    Lanes sum;
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      evaluate(clusters_[i], receivers, light);
      for (std::size_t lane = 0; lane < kTileSamples; ++lane) sum[lane] += light.value[lane];
      light_up_to_[i] = sum;
    }
  }

  // The entry at which the light adds up to that of the ray's stratum.
  std::uint32_t draw(std::size_t lane, int ray, std::uint32_t pixel) const {
    const auto width = static_cast<std::uint32_t>(gbuffer_.width);
    const double at =
        (ray + stratum_offset(pixel % width, pixel / width, pixel, params_.seed)) / params_.rays;
    const double target = at * static_cast<double>(light_up_to_.back()[lane]);
    const auto entry = std::ranges::upper_bound(
        light_up_to_, target, {}, [&](const Lanes& sum) { return static_cast<double>(sum[lane]); });
    return nodes_[static_cast<std::size_t>(entry - light_up_to_.begin())];
  }

  const GBuffer& gbuffer_;
  std::span<const std::uint32_t> nodes_;
  const Sight& sight_;
  const VisibilityParams& params_;
  std::vector<interop::Cluster> clusters_;  // of the nodes
  std::vector<Lanes> light_up_to_;          // of each entry: its luminance and that of those before it
};

// The entries of each tile, chosen without shadows or those of `given`; no pixel is masked.
Cut choose_entries(const VisibilityInputs& inputs, const std::vector<interop::Cluster>& clusters,
                   double error) {
  const GBuffer& gbuffer = *inputs.gbuffer;
  Cut cut;
  if (inputs.cut) {
    cut = *inputs.cut;
  } else {
    cut.width = gbuffer.width;
    cut.height = gbuffer.height;
    cut.anchor = gbuffer.anchor;
    cut.lights = static_cast<int>(inputs.lights.lights.size());
    cut.error = error;
    const TreeTraversal traversal(gbuffer, inputs.lights, clusters);
    append(cut, traversal.cut_all(traversal.criterion(error)));
  }
  cut.masks.assign(cut.nodes.size(), 0);
  cut.mask_words.assign(interop::MASK_WORDS, ~0U);
  return cut;
}

// Of each pixel the share that its rays see; kNoShare for those that no entry lights. Returns the number of
// rays.
std::size_t trace_shares(const GBuffer& gbuffer, const Cut& cut, std::span<const interop::Cluster> clusters,
                         const Sight& sight, const VisibilityParams& params, std::span<float> shares) {
  std::size_t rays = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : rays)
  for (std::size_t tile = 0; tile < cut.tiles.size(); ++tile) {
    const auto nodes = std::span(cut.nodes).subspan(cut.tiles[tile].first, cut.tiles[tile].count);
    if (nodes.empty()) continue;
    TileRays tracing(gbuffer, nodes, clusters, sight, params);
    for (std::size_t block = 0; block < kBlocks; ++block) {
      const TileSamples pixels = pixels_of(gbuffer, cut, tile, block);
      if (pixels.present != 0) rays += tracing.trace(pixels, shares);
    }
  }
  return rays;
}

void report_shares(const Cut& cut, std::span<const float> traced, std::size_t rays, Report& report) {
  const auto per = [](std::size_t amount, std::size_t of) {
    return of == 0 ? 0.0 : static_cast<double>(amount) / static_cast<double>(of);
  };
  std::size_t lit = 0;
  double visible = 0;
  for (std::size_t i = 0; i < traced.size(); ++i) {
    if (traced[i] == kNoShare) continue;
    ++lit;
    visible += static_cast<double>(cut.visibility[i]);
  }
  report.count("entries", cut.nodes.size());
  report.count("entries_per_tile", per(cut.nodes.size(), cut.tiles.size()));
  report.count("rays", rays);
  report.count("rays_per_pixel", per(rays, lit));
  report.count("mean_share", lit == 0 ? 1.0 : visible / static_cast<double>(lit));
}

}  // namespace

Visibility estimate_ratio(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device*,
                          Report& report) {
  const GBuffer& gbuffer = *inputs.gbuffer;
  std::optional<trace::Tracer> tracer;
  std::vector<interop::vec3> normals;
  {
    const PhaseTimer timer(report, "build");
    tracer.emplace(inputs.scene);
    normals = representative_normals(inputs.lights, *tracer);
  }
  const RaySight sight(gbuffer, inputs.lights, normals, *tracer);
  std::vector<interop::Cluster> clusters;
  Cut cut;
  {
    const PhaseTimer timer(report, "choose cut");
    clusters = pack_clusters(inputs.lights);
    cut = choose_entries(inputs, clusters, params.error);
  }
  std::vector<float> traced(gbuffer.pixels.size(), kNoShare);
  std::size_t rays = 0;
  {
    const PhaseTimer timer(report, "rays");
    rays = trace_shares(gbuffer, cut, clusters, sight, params, traced);
  }
  const PhaseTimer timer(report, "filter");
  cut.visibility = filter_shares(gbuffer, traced);
  report_shares(cut, traced, rays, report);
  return cut;
}

}  // namespace vsgl::visibility
