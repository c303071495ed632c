#include "cluster/traverse.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "cluster/cells.h"
#include "cluster/evaluate.h"

namespace vsgl {
namespace {

using interop::Cluster;

// Radiance that counts as dark, in means of the image.
constexpr double kFloorShare = 0.02;
// From this roughness down the traversal starts a level deeper.
constexpr float kNarrowAlpha = 0.05F;
// The error falls as the 2/3rd power of eps; eps at a relative error of 1 (0.003 at 0.02), and what the
// estimate is multiplied by: measured, see docs/cut.md.
constexpr double kThresholdScale = 1.06, kEstimateScale = 2.5;
// Pixels between the samples may receive so many eps from a cluster that they are near to.
constexpr float kNearShare = 8;
// The mean is taken over the samples of at most so many tiles.
constexpr int kMeanTiles = 256;

constexpr int kTile = static_cast<int>(interop::TILE), kCell = kTile / 4;

// ---- Samples

// The pixel of the cell at (x0, y0) that is nearest to (x, y) and not background, or -1; the first of equals.
std::int64_t nearest_pixel(const GBuffer& gbuffer, int x0, int y0, int x, int y) {
  std::int64_t best = -1;
  int best_distance = 1 << 30;
  for (int j = y0; j < std::min(y0 + kCell, gbuffer.height); ++j)
    for (int i = x0; i < std::min(x0 + kCell, gbuffer.width); ++i) {
      const std::int64_t pixel = static_cast<std::int64_t>(j) * gbuffer.width + i;
      const int distance = (i - x) * (i - x) + (j - y) * (j - y);
      if (distance >= best_distance) continue;
      if (gbuffer.pixels[static_cast<std::size_t>(pixel)].id == interop::NO_INSTANCE) continue;
      best = pixel;
      best_distance = distance;
    }
  return best;
}

int tiles_along(int pixels) {
  return (pixels + kTile - 1) / kTile;
}
int tile_count(const GBuffer& gbuffer) {
  return tiles_along(gbuffer.width) * tiles_along(gbuffer.height);
}

// ---- Traversal

// A node whose light at the samples is known and that has yet to be replaced by its children.
struct Pending {
  std::uint32_t node = 0, visible = 0;
  Lanes value;
};

// Bit k: of lane k.
using Mask = std::uint32_t;

float seen(float value, Mask visible, std::size_t lane) {
  return visible >> lane & 1U ? value : 0;
}

bool has_power(const Cluster& c) {
  return c.inverse_variance > 0;
}

// One tile's cut in the making.
class Choice {
 public:
  Choice(const std::vector<Cluster>& clusters, const SampleReceivers& receivers,
         const std::vector<Cell>& cells, const TileSamples& samples, const CutCriterion& criterion,
         const NodeVisibility& visibility)
      : clusters_(clusters),
        receivers_(receivers),
        cells_(cells),
        samples_(samples),
        criterion_(criterion),
        visibility_(visibility) {
    out_.samples = static_cast<std::size_t>(std::popcount(samples.present));
  }

  // `start`: nodes that are looked at in any case.
  TileCut run(std::span<const std::uint32_t> start) {
    std::vector<Node> nodes;
    nodes.reserve(start.size());
    Lanes light;
    light.lane.fill(criterion_.floor);
    for (const std::uint32_t node : start)
      if (has_power(clusters_[node])) add(light, nodes.emplace_back(look_at(node)));
    for (std::size_t k = 0; k < kTileSamples; ++k) {
      const bool present = samples_.present >> k & 1U;
      inverse_light_[k] = present ? 1 / std::max(light[k], kDark) : 0;
    }
    for (const Node& node : nodes) settle(node, false);
    while (!pending_.empty()) refine();
    finish();
    return std::move(out_);
  }

 private:
  struct Node : Pending {
    Lanes bound;
  };
  static constexpr float kDark = 1e-30F;

  Node look_at(std::uint32_t index) {
    ClusterLight light;
    evaluate(clusters_[index], receivers_, light);
    out_.evaluations += out_.samples;
    Node node;
    node.node = index;
    node.visible = visibility_ ? visibility_(index, samples_) : samples_.present;
    node.value = light.value;
    node.bound = light.bound;
    return node;
  }

  static void add(Lanes& sum, const Pending& node) {
    for (std::size_t k = 0; k < kTileSamples; ++k) sum[k] += seen(node.value[k], node.visible, k);
  }

  // Accepts a node, or leaves it to be refined. `close`: its siblings and it agree with their parent.
  void settle(const Node& node, bool close) {
    float share = 0;
    bool hidden = false;
    const float eps = criterion_.threshold;
    for (std::size_t k = 0; k < kTileSamples; ++k) {
      share = std::max(share, node.value[k] * inverse_light_[k]);
      // Horizon guard: the cluster is dark here only because its mean is below a horizon.
      hidden |= node.value[k] < 0.25F * node.bound[k] && node.bound[k] * inverse_light_[k] > 4 * eps;
    }
    const bool leaf = clusters_[node.node].children == 0;
    if (leaf || ((close || share <= eps) && !hidden && !is_near(clusters_[node.node])))
      out_.entries.push_back({node.node, node.visible, share});
    else
      pending_.push_back(node);
  }

  // Whether the cluster may be bright on pixels between the samples: it is nearer to some of them than they
  // are to their sample, and carries more than kNearShare eps of that sample's light there.
  bool is_near(const Cluster& cluster) {
    const float deviation = 1 / std::sqrt(cluster.inverse_variance);
    return std::ranges::any_of(cells_, [&](const Cell& cell) {
      const float x = cluster.position.x - cell.centre.x, y = cluster.position.y - cell.centre.y,
                  z = cluster.position.z - cell.centre.z, reach = cell.radius + 2 * deviation;
      if (x * x + y * y + z * z > reach * reach) return false;
      ClusterLight light;
      evaluate(cluster, cell.receivers, light);
      out_.evaluations += kTileSamples;
      const float limit = kNearShare * criterion_.threshold, inverse = inverse_light_[cell.sample];
      bool bright = false;
      for (std::size_t k = 0; k < kTileSamples; ++k)
        bright |= light.value[k] * inverse > limit || light.bound[k] * inverse > limit;
      return bright;
    });
  }

  // Replaces the topmost pending node by its children.
  void refine() {
    const Pending parent = pending_.back();
    pending_.pop_back();
    std::array<Node, 4> children;
    std::size_t count = 0;
    bool all_leaves = true;
    const std::uint32_t first = clusters_[parent.node].children;
    for (std::uint32_t child = first; child < first + 4; ++child) {
      if (!has_power(clusters_[child])) continue;
      all_leaves = all_leaves && clusters_[child].children == 0;
      children[count++] = look_at(child);
    }
    const bool close = compare(parent, std::span(children).first(count), all_leaves);
    for (std::size_t i = 0; i < count; ++i) settle(children[i], close);
  }

  // Whether the children's sum is that of the parent, shadowed and not, on every sample.
  bool compare(const Pending& parent, std::span<const Node> children, bool exact) {
    Lanes lit, whole;
    for (const Node& child : children) {
      add(lit, child);
      for (std::size_t k = 0; k < kTileSamples; ++k) whole[k] += child.value[k];
    }
    float largest = 0, largest_lit = 0;
    Lanes squares;
    for (std::size_t k = 0; k < kTileSamples; ++k) {
      const float difference = (whole[k] - parent.value[k]) * inverse_light_[k];
      const float shadowed = (lit[k] - seen(parent.value[k], parent.visible, k)) * inverse_light_[k];
      largest = std::max(largest, std::abs(difference));
      largest_lit = std::max(largest_lit, std::abs(shadowed));
      squares[k] = shadowed * shadowed;
    }
    const bool close = largest <= criterion_.threshold && largest_lit <= 2 * criterion_.threshold;
    if (close && !exact)
      for (std::size_t k = 0; k < kTileSamples; ++k) variance_[k] += squares[k];
    return close;
  }

  void finish() {
    std::ranges::sort(out_.entries, {}, &TileCut::Entry::node);
    double sum = 0;
    for (std::size_t k = 0; k < kTileSamples; ++k) sum += static_cast<double>(variance_[k]);
    out_.error = kEstimateScale * std::sqrt(sum / static_cast<double>(out_.samples));
  }

  const std::vector<Cluster>& clusters_;
  const SampleReceivers& receivers_;
  const std::vector<Cell>& cells_;
  const TileSamples& samples_;
  const CutCriterion& criterion_;
  const NodeVisibility& visibility_;
  Lanes inverse_light_;  // 0 where there is no sample
  Lanes variance_;       // sum of the squares of accepted differences
  std::vector<Pending> pending_;
  TileCut out_;
};

}  // namespace

TileSamples tile_samples(const GBuffer& gbuffer, int tile) {
  const int columns = tiles_along(gbuffer.width);
  const int x0 = tile % columns * kTile, y0 = tile / columns * kTile;
  TileSamples out;
  for (int k = 0; k < kTileSamples; ++k) {
    const int i = k % 4, j = k / 4;
    const std::int64_t pixel = nearest_pixel(gbuffer, x0 + i * kCell, y0 + j * kCell, x0 + 5 * i, y0 + 5 * j);
    if (pixel < 0) continue;
    out.pixel[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(pixel);
    out.present |= 1U << k;
  }
  return out;
}

TreeTraversal::TreeTraversal(const GBuffer& gbuffer, const Lights& lights,
                             const std::vector<interop::Cluster>& clusters)
    : gbuffer_(gbuffer), clusters_(clusters), lights_(lights) {
  if (!lights.is_tree())
    throw Error(ErrorCode::invalid_data,
                "lights: method: \"" + lights.method +
                    "\" gives no tree to cut; make them with vsgl-gen --method tree");
  const auto narrow = [](std::uint32_t ndf, float alpha) {
    return ndf != interop::NDF_NONE && alpha <= kNarrowAlpha;
  };
  sharp_ = std::ranges::any_of(gbuffer.pixels,
                               [&](const interop::Surface& s) { return narrow(s.ndf, s.alpha); }) ||
           std::ranges::any_of(clusters,
                               [&](const Cluster& c) { return narrow(c.ndf, std::sqrt(c.masking_alpha2)); });
}

CutCriterion TreeTraversal::criterion(double error) const {
  CutCriterion out;
  out.threshold = static_cast<float>(kThresholdScale * error * std::sqrt(error));
  out.start_level = sharp_ ? 4 : 3;
  out.floor = static_cast<float>(kFloorShare * mean_light(start_nodes(out.start_level)));
  return out;
}

TileCut TreeTraversal::cut(const TileSamples& samples, const CutCriterion& criterion,
                           const NodeVisibility& visibility) const {
  if (samples.present == 0) return {};
  const SampleReceivers receivers = sample_receivers(gbuffer_, samples);
  const std::vector<Cell> cells = cells_of(gbuffer_, samples);
  return Choice(clusters_, receivers, cells, samples, criterion, visibility)
      .run(start_nodes(criterion.start_level));
}

std::vector<std::uint32_t> TreeTraversal::start_nodes(std::uint32_t level) const {
  return level_nodes(lights_.lights, lights_.levels, std::min<std::size_t>(level, lights_.levels.size() - 2));
}

double TreeTraversal::mean_light(std::span<const std::uint32_t> nodes) const {
  const int tiles = tile_count(gbuffer_), step = (tiles + kMeanTiles - 1) / kMeanTiles;
  double sum = 0;
  int count = 0;
  for (int tile = 0; tile < tiles; tile += step) {
    const TileSamples samples = tile_samples(gbuffer_, tile);
    if (samples.present == 0) continue;
    const SampleReceivers receivers = sample_receivers(gbuffer_, samples);
    for (const std::uint32_t node : nodes) {
      if (!has_power(clusters_[node])) continue;
      ClusterLight light;
      evaluate(clusters_[node], receivers, light);
      for (std::size_t k = 0; k < kTileSamples; ++k)
        sum += static_cast<double>(seen(light.value[k], samples.present, k));
    }
    count += std::popcount(samples.present);
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace vsgl
