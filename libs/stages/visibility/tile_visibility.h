#pragma once

#include <vector>

#include "cluster/traverse.h"
#include "stages/visibility/sight.h"
#include "stages/visibility/tile_grid.h"

namespace vsgl::visibility {

// A tile's part of a cut, and how it was found.
struct TileVisibility {
  std::vector<std::uint32_t> nodes;
  std::vector<TileMask> masks;         // a node
  TileMask surfaces;                   // pixels that are no background
  double error = 0;                    // TileCut's
  std::size_t looks = 0;               // pairs looked at that face each other, besides the samples
  std::size_t unmatched = 0;           // pixels
  std::size_t mixed = 0, dropped = 0;  // nodes: samples do not agree; seen by no pixel
};

// Which nodes are looked at pixel by pixel, by the share that they have of some sample's light.
struct Detail {
  float mixed = 0.002F;  // where the samples do not agree: from all pixels of cells whose corners do not
  float edges = 0.004F;  // from pixels at edges
  bool exact = false;    // all nodes from all pixels
};

// Which pixels of the tile see the entries of its cut. Where all samples that face a node agree, so do the
// matched pixels; where they do not, visibility is interpolated; but for what `detail` demands. Unmatched
// pixels look at every node. Nodes that no pixel sees are dropped.
TileVisibility find_tile_visibility(const TileGrid& grid, const TileSamples& samples, const TileCut& cut,
                                    const Sight& sight, const Detail& detail);

// What the samples see of a node, all at once.
Seen see_from_samples(const Sight& sight, std::uint32_t node, const TileSamples& samples);

}  // namespace vsgl::visibility
