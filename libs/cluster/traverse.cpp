#include "cluster/traverse.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "cluster/borders.h"
#include "cluster/cells.h"
#include "cluster/evaluate.h"

namespace vsgl {
namespace {

using interop::Cluster;

// Radiance that counts as dark, in means of the image.
constexpr double kFloorShare = 0.02;
// From this roughness down the traversal starts a level deeper.
constexpr float kNarrowAlpha = 0.05F;
// eps at first, in errors aimed at, and what it is multiplied by while the estimate exceeds that error.
constexpr double kFirstThreshold = 0.15;
constexpr float kStep = 0.7F;
// The estimate counts what the nodes err together, and each by itself, so many times: measured, see
// docs/cut.md.
constexpr double kBias = 3.7, kNoise = 1.4;
// Pixels between the samples may receive so many eps from a cluster that they are near to.
constexpr float kNearShare = 8;
// Lobes of at most this roughness make glints; they are looked for within this part of a cell's radius.
constexpr float kGlintAlpha = 0.1F, kGlintReach = 0.25F;
// What siblings differ by tells the less of what lies further down the less it is: below this error the
// estimate is multiplied by the root of how much smaller the error is, at most of so much.
constexpr double kCautionBelow = 0.05, kMostCaution = 10;
// The mean is taken over the samples of at most so many tiles.
constexpr int kMeanTiles = 256;

constexpr int kTile = static_cast<int>(interop::TILE), kCell = kTile / 4;
static_assert(kCell * kCell == kTileSamples);

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

// Bit k: of lane k.
using Mask = std::uint32_t;

float seen(float value, Mask visible, std::size_t lane) {
  return visible >> lane & 1U ? value : 0;
}

bool has_power(const Cluster& c) {
  return c.inverse_variance > 0;
}

// Four siblings' sum less their parent's value, shadowed, relative to the samples' light.
struct Group {
  Lanes difference;
  Lanes inverse_sum;  // one over the siblings' shadowed shares; 0 where that is nothing
};

// A node of the cut in the making.
struct Node {
  static constexpr std::uint32_t kAlone = ~0U;

  std::uint32_t index = 0, visible = 0;
  std::uint32_t group = kAlone;  // of its siblings; kAlone: it has not come from a refinement
  float share = 0;               // as in TileCut::Entry
  float threshold = 0;           // the least eps at which it stands for its leaves
  Lanes value;
};

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
        visibility_(visibility),
        eps_(criterion.threshold) {
    out_.samples = static_cast<std::size_t>(std::popcount(samples.present));
    for (const Cell& cell : cells)
      glint_reach_[cell.sample] = kGlintReach * static_cast<float>(criterion.caution) * cell.radius;
  }

  // `start`: nodes that are looked at in any case.
  TileCut run(std::span<const std::uint32_t> start) {
    begin(start);
    refine_all();
    while ((out_.error = estimate()) > criterion_.error) {
      eps_ *= kStep;
      reopen();
      refine_all();
    }
    for (const Node& node : accepted_) out_.entries.push_back({node.index, node.visible, node.share});
    std::ranges::sort(out_.entries, {}, &TileCut::Entry::node);
    return std::move(out_);
  }

 private:
  static constexpr float kDark = 1e-30F, kNothing = 1e-9F;

  void begin(std::span<const std::uint32_t> start) {
    std::vector<std::pair<Node, Lanes>> nodes;
    Lanes light;
    light.lane.fill(criterion_.floor);
    for (const std::uint32_t index : start) {
      if (!has_power(clusters_[index])) continue;
      auto& [node, bound] = nodes.emplace_back();
      node = look_at(index, bound);
      for (std::size_t k = 0; k < kTileSamples; ++k) light[k] += seen(node.value[k], node.visible, k);
    }
    for (std::size_t k = 0; k < kTileSamples; ++k) {
      const bool present = samples_.present >> k & 1U;
      inverse_light_[k] = present ? 1 / std::max(light[k], kDark) : 0;
    }
    for (auto& [node, bound] : nodes) settle(node, bound, std::numeric_limits<float>::max());
  }

  Node look_at(std::uint32_t index, Lanes& bound) {
    ClusterLight light;
    evaluate(clusters_[index], receivers_, light);
    out_.evaluations += out_.samples;
    Node node;
    node.index = index;
    node.visible = visibility_ ? visibility_(index, samples_) : samples_.present;
    node.value = light.value;
    bound = light.bound;
    return node;
  }

  // Accepts a node, or leaves it to be refined. `difference`: between its siblings with it and their parent.
  void settle(Node& node, const Lanes& bound, float difference) {
    float hidden = 0;
    for (std::size_t k = 0; k < kTileSamples; ++k) {
      node.share = std::max(node.share, node.value[k] * inverse_light_[k]);
      // Horizon guard: the cluster is dark here only because its mean is below a horizon.
      if (node.value[k] < 0.25F * bound[k]) hidden = std::max(hidden, bound[k] * inverse_light_[k]);
    }
    if (clusters_[node.index].children != 0) {
      node.threshold = std::max(std::min(node.share, difference), 0.25F * hidden);
      if (node.threshold <= eps_)
        node.threshold = std::max(node.threshold, brightest_near(clusters_[node.index]) / kNearShare);
      if (node.threshold <= eps_) node.threshold = std::max(node.threshold, hidden_glint(node) / kNearShare);
    }
    (node.threshold <= eps_ ? accepted_ : pending_).push_back(node);
  }

  // The largest share that the cluster may have in the light of a cell's sample on one of the cell's pixels:
  // of those cells some pixels of which are nearer to it than they are to their sample.
  float brightest_near(const Cluster& cluster) {
    float most = 0;
    for (const Cell& cell : cells_) {
      const float x = cluster.position.x - cell.centre.x, y = cluster.position.y - cell.centre.y,
                  z = cluster.position.z - cell.centre.z, reach = cell.radius + cluster.reach;
      if (x * x + y * y + z * z > reach * reach) continue;
      ClusterLight light;
      evaluate(cluster, cell.receivers, light);
      out_.evaluations += kTileSamples;
      float brightest = 0;
      for (std::size_t k = 0; k < kTileSamples; ++k)
        brightest = std::max({brightest, light.value[k], light.bound[k]});
      most = std::max(most, brightest * inverse_light_[cell.sample]);
    }
    return most;
  }

  // The largest share that the cluster's glints may have in a sample's light, where its own value hides them.
  float hidden_glint(const Node& node) {
    const Cluster& cluster = clusters_[node.index];
    if (cluster.ndf == interop::NDF_NONE || cluster.masking_alpha2 > kGlintAlpha * kGlintAlpha) return 0;
    // A single texel among the children may hold all that shines.
    const bool texels = std::ranges::any_of(std::span(clusters_).subspan(cluster.children, 4),
                                            [](const Cluster& child) { return child.children == 0; });
    Lanes light;
    evaluate_glint(cluster, receivers_, glint_reach_, texels ? 1 : 0, light);
    out_.evaluations += out_.samples;
    float most = 0;
    for (std::size_t k = 0; k < kTileSamples; ++k)
      if (node.value[k] < 0.25F * light[k]) most = std::max(most, light[k] * inverse_light_[k]);
    return most;
  }

  void refine_all() {
    while (!pending_.empty()) {
      const Node parent = pending_.back();
      pending_.pop_back();
      refine(parent);
    }
  }

  // Replaces a node by its children.
  void refine(const Node& parent) {
    std::array<Node, 4> children;
    std::array<Lanes, 4> bounds;
    std::size_t count = 0;
    const std::uint32_t first = clusters_[parent.index].children;
    for (std::uint32_t child = first; child < first + 4; ++child) {
      if (!has_power(clusters_[child])) continue;
      children[count] = look_at(child, bounds[count]);
      children[count++].group = static_cast<std::uint32_t>(groups_.size());
    }
    const float difference = compare(parent, std::span(children).first(count));
    for (std::size_t i = 0; i < count; ++i) settle(children[i], bounds[i], difference);
  }

  // How far the children's sum is from the parent: the largest difference on a sample, or half of that of
  // what is seen.
  float compare(const Node& parent, std::span<const Node> children) {
    Lanes lit, whole;
    for (const Node& child : children)
      for (std::size_t k = 0; k < kTileSamples; ++k) {
        lit[k] += seen(child.value[k], child.visible, k);
        whole[k] += child.value[k];
      }
    float largest = 0;
    Group& group = groups_.emplace_back();
    for (std::size_t k = 0; k < kTileSamples; ++k) {
      const float difference = (whole[k] - parent.value[k]) * inverse_light_[k];
      group.difference[k] = (lit[k] - seen(parent.value[k], parent.visible, k)) * inverse_light_[k];
      const float share = lit[k] * inverse_light_[k];
      group.inverse_sum[k] = share > kNothing ? 1 / share : 0;
      largest = std::max({largest, std::abs(difference), 0.5F * std::abs(group.difference[k])});
    }
    return largest;
  }

  // Nodes that the smaller eps no longer accepts.
  void reopen() {
    const auto open =
        std::ranges::partition(accepted_, [&](const Node& node) { return node.threshold <= eps_; });
    pending_.assign(open.begin(), open.end());
    accepted_.erase(open.begin(), open.end());
  }

  // Relative error that is left, RMS over the samples: a node is taken to err by its part of what it and its
  // siblings differ by from their parent, leaves by nothing.
  double estimate() const {
    Lanes sum, squares;
    for (const Node& node : accepted_) {
      if (node.group == Node::kAlone || clusters_[node.index].children == 0) continue;
      const Group& group = groups_[node.group];
      for (std::size_t k = 0; k < kTileSamples; ++k) {
        const float part = seen(node.value[k], node.visible, k) * inverse_light_[k] * group.inverse_sum[k] *
                           group.difference[k];
        sum[k] += part;
        squares[k] += part * part;
      }
    }
    double total = 0;
    for (std::size_t k = 0; k < kTileSamples; ++k) {
      const double together = kBias * static_cast<double>(sum[k]);
      total += together * together + kNoise * kNoise * static_cast<double>(squares[k]);
    }
    return criterion_.caution * std::sqrt(total / static_cast<double>(out_.samples));
  }

  const std::vector<Cluster>& clusters_;
  const SampleReceivers& receivers_;
  const std::vector<Cell>& cells_;
  const TileSamples& samples_;
  const CutCriterion& criterion_;
  const NodeVisibility& visibility_;
  float eps_;
  Lanes inverse_light_;  // 0 where there is no sample
  Lanes glint_reach_;    // m
  std::vector<Node> pending_, accepted_;
  std::vector<Group> groups_;
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

TileSamples block_pixels(const GBuffer& gbuffer, int left, int top) {
  TileSamples out;
  for (int k = 0; k < kTileSamples; ++k) {
    const int x = left + k % kCell, y = top + k / kCell;
    if (x >= gbuffer.width || y >= gbuffer.height) continue;
    const auto pixel = static_cast<std::uint32_t>(y * gbuffer.width + x);
    if (gbuffer.pixels[pixel].id == interop::NO_INSTANCE) continue;
    out.pixel[static_cast<std::size_t>(k)] = pixel;
    out.present |= 1U << k;
  }
  return out;
}

void append(Cut& cut, std::span<const TileCut> tiles) {
  std::vector<TileRing> rings;
  for (const TileCut& tile : tiles) {
    cut.tiles.push_back({static_cast<std::uint32_t>(cut.nodes.size()),
                         static_cast<std::uint32_t>(tile.entries.size()), static_cast<float>(tile.error)});
    for (const TileCut::Entry& entry : tile.entries) cut.nodes.push_back(entry.node);
    rings.push_back(tile.ring);
  }
  set_gains(cut, rings);
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
  out.error = error;
  out.caution = std::sqrt(std::clamp(kCautionBelow / error, 1.0, kMostCaution));
  out.threshold = static_cast<float>(kFirstThreshold * error / out.caution);
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

TileRing TreeTraversal::ring(int tile, const TileCut& cut, const NodeVisibility& visibility,
                             float small) const {
  const TileSamples samples = ring_samples(gbuffer_, tile);
  TileRing out;
  out.present = samples.present;
  out.entries = cut.entries.size();
  if (samples.present == 0) return out;
  const SampleReceivers receivers = sample_receivers(gbuffer_, samples);
  for (const TileCut::Entry& entry : cut.entries) {
    Mask visible = samples.present;
    const bool all = std::popcount(entry.visible) == static_cast<int>(cut.samples);
    if (entry.share < small && entry.visible == 0) continue;
    if (visibility && !(entry.share < small && all)) visible = visibility(entry.node, samples);
    ClusterLight light;
    evaluate(clusters_[entry.node], receivers, light);
    for (std::size_t k = 0; k < kTileSamples; ++k) out.light[k] += seen(light.value[k], visible, k);
  }
  return out;
}

std::vector<TileCut> TreeTraversal::cut_all(const CutCriterion& criterion) const {
  std::vector<TileCut> tiles(static_cast<std::size_t>(tile_count(gbuffer_)));
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const int tile = static_cast<int>(i);
    tiles[i] = cut(tile_samples(gbuffer_, tile), criterion, {});
    tiles[i].ring = ring(tile, tiles[i], {}, 0);
  }
  return tiles;
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
