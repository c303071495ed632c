#include "stages/visibility/cut_visibility.h"

#include <bit>
#include <string>

#include "cluster/borders.h"
#include "cluster/cluster.h"

namespace vsgl::visibility {
namespace {

// Shares of a sample's light from which on a node is looked at pixel by pixel, relative to the error aimed
// at. docs/visibility.md has the measurement.
constexpr float kMixedShare = 0.02F, kEdgeShare = 0.04F;

// The light's share is unknown: every mixed node matters.
TileCut take_entries(const Cut& given, std::size_t tile, const TileSamples& samples,
                     const NodeVisibility& look) {
  TileCut out;
  out.error = static_cast<double>(given.tiles[tile].error);
  for (std::uint32_t i = 0; i < given.tiles[tile].count; ++i) {
    const std::uint32_t node = given.nodes[given.tiles[tile].first + i];
    out.entries.push_back({node, look(node, samples), 1});
  }
  return out;
}

struct Totals {
  std::size_t looks = 0, surfaces = 0, unmatched = 0, mixed = 0, dropped = 0;

  void add(const TileVisibility& tile) {
    looks += tile.looks;
    surfaces += tile.surfaces.count();
    unmatched += tile.unmatched;
    mixed += tile.mixed;
    dropped += tile.dropped;
  }
};

Cut empty_cut(const GBuffer& gbuffer, const Lights& tree, double error) {
  Cut cut;
  cut.width = gbuffer.width;
  cut.height = gbuffer.height;
  cut.anchor = gbuffer.anchor;
  cut.lights = static_cast<int>(tree.lights.size());
  cut.error = error;
  cut.mask_words.assign(interop::MASK_WORDS, ~0U);
  return cut;
}

void append(Cut& cut, const TileVisibility& tile) {
  cut.tiles.push_back({static_cast<std::uint32_t>(cut.nodes.size()),
                       static_cast<std::uint32_t>(tile.nodes.size()), static_cast<float>(tile.error)});
  for (std::size_t i = 0; i < tile.nodes.size(); ++i) {
    cut.nodes.push_back(tile.nodes[i]);
    if (tile.masks[i] == tile.surfaces) {
      cut.masks.push_back(0);
      continue;
    }
    cut.masks.push_back(static_cast<std::uint32_t>(cut.mask_words.size() / interop::MASK_WORDS));
    cut.mask_words.insert(cut.mask_words.end(), tile.masks[i].words.begin(), tile.masks[i].words.end());
  }
}

void report_cut(const Cut& cut, const Totals& totals, const char* looks, Report& report) {
  const auto per = [](std::size_t amount, std::size_t of) {
    return of == 0 ? 0.0 : static_cast<double>(amount) / static_cast<double>(of);
  };
  report.count("entries", cut.nodes.size());
  report.count("entries_per_tile", per(cut.nodes.size(), cut.tiles.size()));
  report.count("masks", cut.mask_words.size() / interop::MASK_WORDS);
  report.count("mixed_entries", totals.mixed);
  report.count("unseen_entries", totals.dropped);
  report.count("unmatched_pixels", totals.unmatched);
  report.count(looks, totals.looks);
  report.count(std::string(looks) + "_per_pixel", per(totals.looks, totals.surfaces));
}

}  // namespace

Cut find_cut_visibility(const GBuffer& gbuffer, const Lights& tree, const Cut* given, const Sight& sight,
                        const VisibilityParams& params, Report& report) {
  Cut cut = empty_cut(gbuffer, tree, given ? given->error : params.error);
  std::vector<TileVisibility> tiles(static_cast<std::size_t>(cut.columns()) *
                                    static_cast<std::size_t>(cut.rows()));
  const std::vector<interop::Cluster> clusters = pack_clusters(tree);
  const TreeTraversal traversal(gbuffer, tree, clusters);
  const CutCriterion criterion = given ? CutCriterion{} : traversal.criterion(params.error);
  const auto error = static_cast<float>(params.error);
  const Detail detail{.mixed = kMixedShare * error, .edges = kEdgeShare * error, .exact = params.exact};
  std::vector<TileRing> rings(tiles.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
    const int number = static_cast<int>(tile);
    const TileSamples samples = tile_samples(gbuffer, number);
    if (samples.present == 0) continue;
    std::size_t looks = 0;
    const NodeVisibility look = [&](std::uint32_t node, const TileSamples& at) {
      const Seen seen = see_from_samples(sight, node, at);
      looks += static_cast<std::size_t>(std::popcount(seen.facing));
      return seen.visible;
    };
    const TileCut chosen =
        given ? take_entries(*given, tile, samples, look) : traversal.cut(samples, criterion, look);
    rings[tile] = traversal.ring(number, chosen, look, detail.mixed);
    tiles[tile] = find_tile_visibility({gbuffer, number, samples}, samples, chosen, sight, detail);
    tiles[tile].looks += looks;
  }
  Totals totals;
  for (const TileVisibility& tile : tiles) {
    append(cut, tile);
    totals.add(tile);
  }
  set_gains(cut, rings);
  report_cut(cut, totals, sight.name(), report);
  return cut;
}

}  // namespace vsgl::visibility
