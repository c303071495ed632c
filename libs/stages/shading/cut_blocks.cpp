#include "stages/shading/cut_blocks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "cluster/cluster.h"
#include "interop/model.h"
#include "interop/shading.h"
#include "math/interop_vec.h"
#include "math/microfacet.h"
#include "stages/shading/cut_pixels.h"

namespace vsgl {
namespace {

using interop::Cluster;
using interop::CUT_BLOCK;
using interop::Surface;
using interop::TILE;

constexpr int kTile = static_cast<int>(TILE), kSquare = 8;
constexpr std::uint32_t kUnused = 0xFFFFFFFFu;

bool is_bumped(const Surface& s) {
  return s.normal.x != s.shading_normal.x || s.normal.y != s.shading_normal.y ||
         s.normal.z != s.shading_normal.z;
}

// Calls visit(pixel) for those of a tile, square by square.
template <class Visit>
void visit_tile(const GBuffer& gbuffer, int tile_x, int tile_y, Visit visit) {
  for (int square = 0; square < 4; ++square) {
    const int left = tile_x * kTile + square % 2 * kSquare, top = tile_y * kTile + square / 2 * kSquare;
    for (int y = top; y < std::min(top + kSquare, gbuffer.height); ++y)
      for (int x = left; x < std::min(left + kSquare, gbuffer.width); ++x)
        visit(static_cast<std::uint32_t>(y * gbuffer.width + x));
  }
}

// Starts a block where the last one is full or another tile's.
void append(CutReceivers& receivers, std::uint32_t tile, std::uint32_t pixel) {
  if (receivers.blocks.empty() || receivers.blocks.back().tile != tile ||
      receivers.blocks.back().count == CUT_BLOCK)
    receivers.blocks.push_back({tile, static_cast<std::uint32_t>(receivers.pixels.size()), 0});
  receivers.pixels.push_back(pixel);
  ++receivers.blocks.back().count;
}

bool has_specular(const Cluster& c) {
  return c.ndf != interop::NDF_NONE;
}

// Box about the receivers of a block, and the sharpest of their lobes across the plane of incidence.
struct Bounds {
  std::array<float, 3> low, high;
  float across = 0;

  Bounds() {
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
  }
  void add(interop::vec3 p) {
    const float at[] = {p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], at[k]);
      high[k] = std::max(high[k], at[k]);
    }
  }
  float distance2(interop::vec3 p) const {
    const float at[] = {p.x, p.y, p.z};
    float sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const float d = std::max({low[k] - at[k], at[k] - high[k], 0.0f});
      sum += d * d;
    }
    return sum;
  }
  // As fvpl_is_point() for all receivers at once.
  bool is_point(const Cluster& c) const {
    const float sharpness = distance2(c.position) * c.inverse_variance;
    return sharpness > interop::CLUSTER_POINT && sharpness > interop::CLUSTER_POINT_SPECULAR * across;
  }
};

// SpecularReceiver::across.
float lobe_sharpness_across(const GBuffer& gbuffer, const Surface& s) {
  const Vec3 view = normalise(gbuffer.camera - to_double(s.position));
  const double cosine = std::max(dot(view, to_double(s.shading_normal)), cos_min);
  return static_cast<float>(ndf_sharpness(s.ndf, static_cast<double>(s.alpha)) / (4 * cosine * cosine));
}

// Lists of one block.
class BlockLists {
 public:
  BlockLists(const GBuffer& gbuffer, const Cut& cut, const CutReceivers& receivers,
             const CutReceivers::Block& block)
      : cut_(cut), pixels_(std::span(receivers.pixels).subspan(block.first, block.count)) {
    for (std::size_t k = 0; k < pixels_.size(); ++k) {
      const Surface& s = gbuffer.pixels[pixels_[k]];
      bounds_.add(s.position);
      if (receivers.ndf != interop::NDF_NONE && s.ndf != interop::NDF_NONE)
        bounds_.across = std::max(bounds_.across, lobe_sharpness_across(gbuffer, s));
      const std::uint32_t x = pixels_[k] % static_cast<std::uint32_t>(gbuffer.width) % TILE,
                          y = pixels_[k] / static_cast<std::uint32_t>(gbuffer.width) % TILE;
      bits_[k] = static_cast<std::uint8_t>(y * TILE + x);
    }
  }

  void fill(const CutClusters& clusters, const Cut::Tile& tile, bool skip) {
    for (std::uint32_t e = tile.first; e < tile.first + tile.count; ++e) {
      const std::uint64_t mask = seen_by(e);
      if (mask == 0 && skip) {
        ++unseen;
        continue;
      }
      const std::uint32_t index = clusters.entries[e];
      const Cluster& c = clusters.clusters[index];
      const bool plain = c.normal_sharpness > interop::CLUSTER_FLAT && !has_specular(c);
      std::vector<std::uint32_t>& list = lists[!bounds_.is_point(c) ? 2 : plain ? 0 : 1];
      list.push_back(index);
      if (!cut_.has_visibility()) continue;
      list.push_back(static_cast<std::uint32_t>(mask));
      list.push_back(static_cast<std::uint32_t>(mask >> 32));
    }
  }

  std::array<std::vector<std::uint32_t>, 3> lists;  // points, distant, general
  std::size_t unseen = 0;

 private:
  // Bit k: receiver k of the block sees the entry.
  std::uint64_t seen_by(std::uint32_t entry) const {
    const std::uint64_t all = ~std::uint64_t{0} >> (CUT_BLOCK - pixels_.size());
    if (!cut_.has_visibility() || cut_.masks[entry] == 0) return all;
    const std::uint32_t* words =
        &cut_.mask_words[std::size_t{cut_.masks[entry]} * std::size_t{interop::MASK_WORDS}];
    std::uint64_t mask = 0;
    for (std::size_t k = 0; k < pixels_.size(); ++k)
      mask |= std::uint64_t{words[bits_[k] / 32] >> (bits_[k] % 32) & 1u} << k;
    return mask;
  }

  const Cut& cut_;
  std::span<const std::uint32_t> pixels_;
  Bounds bounds_;
  std::array<std::uint8_t, CUT_BLOCK> bits_{};  // of a tile's mask
};

}  // namespace

std::vector<CutReceivers> sort_into_blocks(const GBuffer& gbuffer, std::span<const std::uint8_t> kinds,
                                           std::span<const std::uint8_t> shaded, bool skip) {
  std::array<CutReceivers, interop::NDF_ANY + 1> lists;
  std::uint32_t tile = 0;
  for (int y = 0; y * kTile < gbuffer.height; ++y)
    for (int x = 0; x * kTile < gbuffer.width; ++x, ++tile)
      visit_tile(gbuffer, x, y, [&](std::uint32_t pixel) {
        if (!shaded[pixel]) return;
        CutReceivers& list = lists[skip ? kinds[pixel] : interop::NDF_ANY];
        list.bumped = list.bumped || !skip || is_bumped(gbuffer.pixels[pixel]);
        append(list, tile, pixel);
      });
  std::vector<CutReceivers> out;
  for (std::uint32_t ndf = 0; ndf < lists.size(); ++ndf) {
    lists[ndf].ndf = ndf;
    if (!lists[ndf].pixels.empty()) out.push_back(std::move(lists[ndf]));
  }
  return out;
}

CutClusters gather_clusters(const Lights& lights, const Cut& cut) {
  std::vector<std::uint32_t> place(lights.lights.size(), kUnused);
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < cut.nodes.size(); ++e)
    std::atomic_ref(place[cut.nodes[e]]).store(0, std::memory_order_relaxed);
  Lights used;
  used.scene_radius = lights.scene_radius;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] == kUnused) continue;
    place[i] = static_cast<std::uint32_t>(used.lights.size());
    used.lights.push_back(lights.lights[i]);
  }
  CutClusters out;
  out.clusters = pack_clusters(used);
  out.entries.resize(cut.nodes.size());
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < cut.nodes.size(); ++e) out.entries[e] = place[cut.nodes[e]];
  for (const Cluster& c : out.clusters) {
    if (!has_specular(c)) continue;
    out.ndf = out.ndf == interop::NDF_NONE || out.ndf == c.ndf ? c.ndf : interop::NDF_ANY;
  }
  return out;
}

CutLists build_lists(const GBuffer& gbuffer, const Cut& cut, const CutClusters& clusters,
                     const CutReceivers& receivers, std::span<const CutReceivers::Block> blocks, bool skip,
                     CutCounts& counts) {
  std::vector<std::array<std::vector<std::uint32_t>, 3>> lists(blocks.size());
  std::size_t unseen = 0;
#pragma omp parallel for schedule(dynamic, 16) reduction(+ : unseen)
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    BlockLists block(gbuffer, cut, receivers, blocks[b]);
    block.fill(clusters, cut.tiles[blocks[b].tile], skip);
    unseen += block.unseen;
    lists[b] = std::move(block.lists);
  }
  counts.unseen += unseen;

  CutLists out;
  const std::size_t words = cut.has_visibility() ? interop::CUT_MASKED_ITEM : interop::CUT_ITEM;
  std::size_t next = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t points = lists[b][0].size() / words, distant = lists[b][1].size() / words,
                      general = lists[b][2].size() / words;
    const auto at = [](std::size_t item) { return static_cast<std::uint32_t>(item); };
    out.blocks.push_back({blocks[b].first - blocks.front().first, blocks[b].count, at(next),
                          at(next + points), at(next + points + distant),
                          at(next + points + distant + general)});
    counts.points += points;
    counts.distant += distant;
    counts.general += general;
    counts.evaluations += (points + distant + general) * blocks[b].count;
    next += points + distant + general;
  }
  out.items.resize(next * words);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    auto target = out.items.begin() + static_cast<std::ptrdiff_t>(out.blocks[b].points * words);
    for (const auto& list : lists[b]) target = std::copy(list.begin(), list.end(), target);
  }
  return out;
}

}  // namespace vsgl
