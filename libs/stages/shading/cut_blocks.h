#pragma once

// What the kernel that shades by a cut is given: blocks of pixels, and for each the clusters of its tile,
// sorted by what their evaluation needs.

#include <cstdint>
#include <span>
#include <vector>

#include "artifact/artifact.h"
#include "interop/cut_shading.h"

namespace vsgl {

// What pixels ask of the kernel.
struct CutKernel {
  std::uint32_t ndf = interop::NDF_NONE;  // of all of them; without `skip` NDF_ANY, though they are the same
  bool wide = true;                       // blocks of CUT_BLOCK; else of the narrow width
  bool bumped = false;                    // a shading normal differs from its geometric one
};

// Pixels that one pipeline serves, block after block.
struct CutReceivers : CutKernel {
  struct Block {
    std::uint32_t tile = 0;
    std::uint32_t first = 0, count = 0;  // of `pixels`; at most CUT_BLOCK
  };
  std::vector<std::uint32_t> pixels;  // of the image
  std::vector<Block> blocks;
};
// Receivers of a narrow block at most; of a wide one: CUT_BLOCK.
inline constexpr std::uint32_t kNarrowBlock = interop::CUT_BLOCK / 2;

// The pixels whose `shaded` is 1, tile by tile; within a tile by squares of 8x8. Where so few are left of a
// tile that a narrow block takes them, one does.
std::vector<CutReceivers> sort_into_blocks(const GBuffer& gbuffer, std::span<const std::uint8_t> kinds,
                                           std::span<const std::uint8_t> shaded, bool skip);

// Those nodes of a tree that a cut uses.
struct CutClusters {
  std::vector<interop::Cluster> clusters;
  std::vector<std::uint32_t> entries;     // of each entry of the cut: its cluster
  std::uint32_t ndf = interop::NDF_NONE;  // of their specular emission; NDF_ANY: several
};
CutClusters gather_clusters(const Lights& lights, const Cut& cut);

// Counts of the items of lists, and of evaluations (items times receivers).
struct CutCounts {
  std::size_t plain = 0, glossy = 0, middle = 0, near = 0;
  std::size_t unseen = 0;  // entries that no receiver of a block sees, left out
  std::size_t dark = 0;    // entries that face away from all receivers of a block, left out
  std::size_t evaluations = 0;
};
struct CutLists {
  std::vector<interop::CutBlock> blocks;
  std::vector<std::uint32_t> items;  // CUT_ITEM or, where visibility is known, CUT_MASKED_ITEM words each
};
// Lists of some successive blocks, whose receivers count from that of the first. Adds to `counts`.
CutLists build_lists(const GBuffer& gbuffer, const Cut& cut, const CutClusters& clusters,
                     const CutReceivers& receivers, std::span<const CutReceivers::Block> blocks, bool skip,
                     CutCounts& counts);

}  // namespace vsgl
