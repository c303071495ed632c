#include "stages/visibility/tile_visibility.h"

#include <array>
#include <bit>

namespace vsgl::visibility {
namespace {

static_assert(kTileSamples <= kMaxPairs);

// The pairs of a node and the samples that are present; `bits` of an answer belong to them in this order.
struct SamplePairs {
  std::array<Pair, kTileSamples> pairs;
  std::size_t count = 0;

  SamplePairs(std::uint32_t node, const TileSamples& samples) {
    for (std::uint32_t present = samples.present; present != 0; present &= present - 1)
      pairs[count++] = {node, samples.pixel[static_cast<std::size_t>(std::countr_zero(present))]};
  }
  std::span<const Pair> span() const { return std::span(pairs).first(count); }
};

// Moves bit i of `bits` to the place of the i-th set bit of `places`.
std::uint32_t spread(std::uint32_t bits, std::uint32_t places) {
  std::uint32_t out = 0;
  for (; places != 0; places &= places - 1, bits >>= 1)
    if ((bits & 1U) != 0) out |= places & -places;
  return out;
}

// Pairs that wait for a full packet; answers go to the bits of their masks.
class PairQueue {
 public:
  PairQueue(const Sight& sight, const TileGrid& grid, std::vector<TileMask>& masks)
      : sight_(sight), grid_(grid), masks_(masks) {}

  // A look at the node from each of the pixels.
  void push(std::size_t entry, std::uint32_t node, const TileMask& pixels) {
    for (std::uint32_t w = 0; w < interop::MASK_WORDS; ++w)
      for (std::uint32_t word = pixels.words[w]; word != 0; word &= word - 1) {
        const std::uint32_t bit = 32 * w + static_cast<std::uint32_t>(std::countr_zero(word));
        pairs_[count_] = {node, grid_.pixel(bit)};
        targets_[count_++] = {entry, bit};
        if (count_ == kMaxPairs) flush();
      }
  }
  void flush() {
    const Seen seen = sight_.see(std::span(pairs_).first(count_));
    for (std::uint32_t visible = seen.visible; visible != 0; visible &= visible - 1) {
      const Target& target = targets_[static_cast<std::size_t>(std::countr_zero(visible))];
      masks_[target.entry].set(target.bit);
    }
    looks_ += static_cast<std::size_t>(std::popcount(seen.facing));
    count_ = 0;
  }
  std::size_t looks() const { return looks_; }

 private:
  struct Target {
    std::size_t entry;
    std::uint32_t bit;
  };
  const Sight& sight_;
  const TileGrid& grid_;
  std::vector<TileMask>& masks_;
  std::array<Pair, kMaxPairs> pairs_;
  std::array<Target, kMaxPairs> targets_;
  std::size_t count_ = 0, looks_ = 0;
};

void drop_unseen(TileVisibility& out) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < out.nodes.size(); ++i) {
    if (out.masks[i].none()) continue;
    out.nodes[kept] = out.nodes[i];
    out.masks[kept++] = out.masks[i];
  }
  out.dropped = out.nodes.size() - kept;
  out.nodes.resize(kept);
  out.masks.resize(kept);
}

}  // namespace

Seen see_from_samples(const Sight& sight, std::uint32_t node, const TileSamples& samples) {
  const SamplePairs pairs(node, samples);
  const Seen seen = sight.see(pairs.span());
  return {spread(seen.facing, samples.present), spread(seen.visible, samples.present)};
}

TileVisibility find_tile_visibility(const TileGrid& grid, const TileSamples& samples, const TileCut& cut,
                                    const Sight& sight, const Detail& detail) {
  TileVisibility out;
  out.error = cut.error;
  out.surfaces = grid.surfaces();
  out.unmatched = grid.unmatched().count();
  out.masks.resize(cut.entries.size());
  PairQueue queue(sight, grid, out.masks);
  for (std::size_t i = 0; i < cut.entries.size(); ++i) {
    const TileCut::Entry& entry = cut.entries[i];
    out.nodes.push_back(entry.node);
    const SamplePairs pairs(entry.node, samples);
    const std::uint32_t facing = spread(sight.facing(pairs.span()), samples.present);
    const std::uint32_t visible = entry.visible & facing;
    const bool mixed = visible != 0 && visible != facing;
    out.mixed += mixed;
    TileMask looking = grid.unmatched();
    if (detail.exact) looking = grid.surfaces();
    if (mixed && entry.share >= detail.mixed) looking |= grid.undecided(visible);
    if (entry.share >= detail.edges) looking |= grid.edges();
    if (mixed)
      out.masks[i] = grid.interpolate(visible) & ~looking;
    else if (visible != 0)
      out.masks[i] = grid.matched() & ~looking;
    queue.push(i, entry.node, looking);
  }
  queue.flush();
  out.looks = queue.looks();
  drop_unseen(out);
  return out;
}

}  // namespace vsgl::visibility
