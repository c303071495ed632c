#pragma once

#include <vector>

#include "cluster/traverse.h"
#include "stages/visibility/sight.h"
#include "stages/visibility/tile_grid.h"

namespace vsgl::visibility {

// A tile's part of a cut, and how it was found.
struct TileVisibility {
  std::vector<std::uint32_t> nodes;
  std::vector<TileMask> masks;  // a node
  double error = 0;             // TileCut's
  std::size_t looks = 0;        // pairs looked at one by one that face each other, besides the samples
  std::size_t surfaces = 0, unmatched = 0;  // pixels
  std::size_t mixed = 0, dropped = 0;       // nodes: not all samples agreed; seen by no pixel
};

enum class Detail {
  adaptive,  // mixed nodes that matter are looked at pixel by pixel, others interpolated
  exact,     // all nodes are looked at pixel by pixel
};

// Which pixels of the tile see the entries of its cut. Where all samples that face a node agree, so do the
// matched pixels; mixed nodes of at least kPixelShare of some sample's light are looked at from each pixel,
// the others' visibility is interpolated. Unmatched pixels look at every node. Nodes that no pixel sees are
// dropped.
inline constexpr float kPixelShare = 0.01F;
TileVisibility find_tile_visibility(const TileGrid& grid, const TileSamples& samples, const TileCut& cut,
                                    const Sight& sight, Detail detail);

// What the samples see of a node, all at once.
Seen see_from_samples(const Sight& sight, std::uint32_t node, const TileSamples& samples);

}  // namespace vsgl::visibility
