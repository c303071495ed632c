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
#include "stages/shading/cut_pixels.h"

namespace vsgl {
namespace {

using interop::Cluster;
using interop::CUT_BLOCK;
using interop::Surface;
using interop::TILE;

constexpr int kTile = static_cast<int>(TILE), kSquare = 8;
// Shading normals that differ by less count as the geometric ones: interpolation leaves rounding.
constexpr double kBend = 1e-5;
constexpr std::size_t kClasses = 4;
constexpr std::uint32_t kUnused = 0xFFFFFFFFu;

bool is_bumped(const Surface& s) {
  const Vec3 bend = to_double(s.shading_normal) - to_double(s.normal);
  return dot(bend, bend) > kBend * kBend;
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

// Moves the pixels of one tile into blocks of at most `size`.
void append(CutReceivers& receivers, std::uint32_t tile, std::span<const std::uint32_t> pixels,
            std::uint32_t size) {
  for (std::size_t first = 0; first < pixels.size(); first += size) {
    const std::span part = pixels.subspan(first, std::min<std::size_t>(size, pixels.size() - first));
    receivers.blocks.push_back(
        {tile, static_cast<std::uint32_t>(receivers.pixels.size()), static_cast<std::uint32_t>(part.size())});
    receivers.pixels.insert(receivers.pixels.end(), part.begin(), part.end());
  }
}

bool has_specular(const Cluster& c) {
  return c.ndf != interop::NDF_NONE;
}

// Box about the receivers of a block.
struct Bounds {
  std::array<float, 3> low, high;

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
  // The largest of (x - p).n over the box.
  float height(interop::vec3 p, interop::vec3 n) const {
    const float at[] = {p.x, p.y, p.z}, normal[] = {n.x, n.y, n.z};
    float sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += normal[k] * ((normal[k] > 0 ? high[k] : low[k]) - at[k]);
    return sum;
  }
};

// Lists of one block.
class BlockLists {
 public:
  BlockLists(const GBuffer& gbuffer, const Cut& cut, const CutReceivers& receivers,
             const CutReceivers::Block& block)
      : cut_(cut),
        pixels_(std::span(receivers.pixels).subspan(block.first, block.count)),
        diffuse_(receivers.ndf == interop::NDF_NONE) {
    for (std::size_t k = 0; k < pixels_.size(); ++k) {
      const Surface& s = gbuffer.pixels[pixels_[k]];
      bounds_.add(s.position);
      const std::uint32_t x = pixels_[k] % static_cast<std::uint32_t>(gbuffer.width) % TILE,
                          y = pixels_[k] / static_cast<std::uint32_t>(gbuffer.width) % TILE;
      bits_[k] = static_cast<std::uint8_t>(y * TILE + x);
    }
  }

  void fill(const CutClusters& clusters, const Cut::Tile& tile, bool skip) {
    for (std::uint32_t e = tile.first; e < tile.first + tile.count; ++e) {
      const std::uint64_t mask = seen_by(e);
      const std::uint32_t index = clusters.entries[e];
      const Cluster& c = clusters.clusters[index];
      if (skip && mask == 0) {
        ++unseen;
        continue;
      }
      if (skip && is_flat(c) && bounds_.height(c.position, c.normal) <= 0) {
        ++dark;
        continue;
      }
      std::vector<std::uint32_t>& list = lists[class_of(c)];
      list.push_back(index);
      if (!cut_.has_visibility()) continue;
      list.insert(list.end(), {static_cast<std::uint32_t>(mask), static_cast<std::uint32_t>(mask >> 32), 0});
    }
  }

  std::array<std::vector<std::uint32_t>, kClasses> lists;  // plain, glossy, middle, near
  std::size_t unseen = 0, dark = 0;

 private:
  static bool is_flat(const Cluster& c) { return c.normal_sharpness > interop::CLUSTER_FLAT; }

  std::size_t class_of(const Cluster& c) const {
    const float sharpness = bounds_.distance2(c.position) * c.inverse_variance;
    if (sharpness > interop::CLUSTER_POINT && is_flat(c)) return has_specular(c) ? 1 : 0;
    return diffuse_ && sharpness > interop::CLUSTER_MIDDLE ? 2 : 3;
  }

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
  bool diffuse_;  // no receiver has a specular lobe
  Bounds bounds_;
  std::array<std::uint8_t, CUT_BLOCK> bits_{};  // of a tile's mask
};

}  // namespace

std::vector<CutReceivers> sort_into_blocks(const GBuffer& gbuffer, std::span<const std::uint8_t> kinds,
                                           std::span<const std::uint8_t> shaded, bool skip) {
  constexpr std::size_t kKinds = interop::NDF_ANY;
  std::array<CutReceivers, 2 * kKinds> lists;  // wide, narrow
  std::array<std::vector<std::uint32_t>, kKinds> pixels;
  std::array<bool, kKinds> bumped{};
  std::uint32_t tile = 0;
  for (int y = 0; y * kTile < gbuffer.height; ++y)
    for (int x = 0; x * kTile < gbuffer.width; ++x, ++tile) {
      visit_tile(gbuffer, x, y, [&](std::uint32_t pixel) {
        if (!shaded[pixel]) return;
        const std::uint8_t kind = kinds[pixel];
        bumped[kind] = bumped[kind] || !skip || is_bumped(gbuffer.pixels[pixel]);
        pixels[kind].push_back(pixel);
      });
      for (std::size_t kind = 0; kind < kKinds; ++kind) {
        const std::span all(pixels[kind]);
        const std::size_t rest = all.size() % CUT_BLOCK,
                          wide = rest <= kNarrowBlock ? all.size() - rest : all.size();
        append(lists[2 * kind], tile, all.first(wide), CUT_BLOCK);
        append(lists[2 * kind + 1], tile, all.subspan(wide), kNarrowBlock);
        pixels[kind].clear();
      }
    }
  std::vector<CutReceivers> out;
  for (std::uint32_t i = 0; i < lists.size(); ++i) {
    lists[i].ndf = skip ? i / 2 : interop::NDF_ANY;
    lists[i].wide = i % 2 == 0;
    lists[i].bumped = bumped[i / 2];
    if (!lists[i].pixels.empty()) out.push_back(std::move(lists[i]));
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
  std::vector<std::array<std::vector<std::uint32_t>, kClasses>> lists(blocks.size());
  std::size_t unseen = 0, dark = 0;
#pragma omp parallel for schedule(dynamic, 16) reduction(+ : unseen, dark)
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    BlockLists block(gbuffer, cut, receivers, blocks[b]);
    block.fill(clusters, cut.tiles[blocks[b].tile], skip);
    unseen += block.unseen;
    dark += block.dark;
    lists[b] = std::move(block.lists);
  }
  counts.unseen += unseen;
  counts.dark += dark;

  CutLists out;
  const std::size_t words = cut.has_visibility() ? interop::CUT_MASKED_ITEM : interop::CUT_ITEM;
  std::array<std::size_t*, kClasses> totals = {&counts.plain, &counts.glossy, &counts.middle, &counts.near};
  std::size_t next = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::array<std::uint32_t, kClasses + 1> first{static_cast<std::uint32_t>(next)};
    for (std::size_t k = 0; k < kClasses; ++k) {
      const std::size_t items = lists[b][k].size() / words;
      *totals[k] += items;
      counts.evaluations += items * blocks[b].count;
      next += items;
      first[k + 1] = static_cast<std::uint32_t>(next);
    }
    out.blocks.push_back({blocks[b].first - blocks.front().first, blocks[b].count, first[0], first[1],
                          first[2], first[3], first[4]});
  }
  out.items.resize(next * words);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    auto target = out.items.begin() + static_cast<std::ptrdiff_t>(out.blocks[b].plain * words);
    for (const auto& list : lists[b]) target = std::copy(list.begin(), list.end(), target);
  }
  return out;
}

}  // namespace vsgl
