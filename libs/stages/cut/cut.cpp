#include "stages/cut/cut.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "cluster/cluster.h"
#include "cluster/traverse.h"

namespace vsgl {
namespace {

// In radii of the scene.
constexpr double kAnchorTolerance = 1e-6;

void check(const GBuffer& gbuffer, const Lights& lights, const CutParams& params) {
  if (!(params.error >= 1e-5 && params.error <= 1))
    throw Error(ErrorCode::out_of_range, "error: " + std::to_string(params.error) + " is not 1e-5..1");
  if (length(lights.anchor - gbuffer.anchor) > kAnchorTolerance * gbuffer.scene_radius)
    throw Error(ErrorCode::invalid_data,
                "lights: anchor differs from the G-buffer's; make both from the same scene");
}

struct Totals {
  std::vector<std::uint32_t> sizes;  // of the cuts of tiles with pixels
  std::size_t evaluations = 0, samples = 0, skipped = 0;
  double squared_error = 0;
};

Totals total(const std::vector<TileCut>& tiles) {
  Totals totals;
  for (const TileCut& tile : tiles) {
    totals.evaluations += tile.evaluations;
    totals.samples += tile.samples;
    if (tile.samples == 0) {
      ++totals.skipped;
      continue;
    }
    totals.sizes.push_back(static_cast<std::uint32_t>(tile.entries.size()));
    totals.squared_error += tile.error * tile.error;
  }
  return totals;
}

void describe(Totals totals, Report& report) {
  const std::size_t tiles = totals.sizes.size();
  nlohmann::ordered_json size = {{"mean", 0}, {"median", 0}, {"largest", 0}};
  double error = 0, evaluations = 0;
  if (tiles > 0) {
    std::ranges::sort(totals.sizes);
    double sum = 0;
    for (const std::uint32_t count : totals.sizes) sum += count;
    size["mean"] = sum / static_cast<double>(tiles);
    size["median"] = totals.sizes[tiles / 2];
    size["largest"] = totals.sizes.back();
    error = std::sqrt(totals.squared_error / static_cast<double>(tiles));
    evaluations = static_cast<double>(totals.evaluations) / static_cast<double>(totals.samples);
  }
  report.count("cut_size", size);
  report.count("evaluations_per_sample", evaluations);
  report.count("estimated_error", error);
  if (totals.skipped > 0)
    report.skipped(std::to_string(totals.skipped) + " tiles", "the camera sees nothing there");
}

}  // namespace

Cut build_cut(const GBuffer& gbuffer, const Lights& lights, const CutParams& params, Report& report) {
  check(gbuffer, lights, params);
  Cut cut;
  cut.width = gbuffer.width;
  cut.height = gbuffer.height;
  cut.anchor = lights.anchor;
  cut.lights = static_cast<int>(lights.lights.size());
  cut.error = params.error;
  std::vector<TileCut> tiles;
  {
    const PhaseTimer timer(report, "choose cut");
    const std::vector<interop::Cluster> clusters = pack_clusters(lights);
    const TreeTraversal traversal(gbuffer, lights, clusters);
    tiles = traversal.cut_all(traversal.criterion(params.error));
  }
  append(cut, tiles);
  describe(total(tiles), report);
  return cut;
}

}  // namespace vsgl
