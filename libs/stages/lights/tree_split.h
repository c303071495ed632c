#pragma once

// The k-d tree over the lit texels of an RSM: which texels make up a node. docs/sampling.md describes it.

#include <array>
#include <cstdint>
#include <vector>

#include "artifact/artifact.h"

namespace vsgl {

// A texel as the splits see it. `index` counts row by row over the RSM's layers.
struct LitTexel {
  std::array<float, 6> feature;  // position and normal, counted in steps that make both comparable; the
                                 // normal is the geometric one, under a specular lobe that of shading, whose
                                 // spread no single lobe can stand for
  std::uint32_t index;
};

// texels[begin..end) of the tree; children: the first of four nodes, 0 for a leaf. A leaf holds one texel, or
// none at all: such nodes fill up the four children of a node of fewer texels. There are at most two.
struct TreeNode {
  std::uint32_t begin = 0, end = 0;
  std::uint32_t children = 0;

  std::uint32_t size() const { return end - begin; }
};

struct TexelTree {
  std::vector<LitTexel> texels;       // in an order that makes every node's consecutive
  std::vector<TreeNode> nodes;        // level by level from the root, the children of a node consecutive
  std::vector<std::uint32_t> levels;  // first node of each level, and the number of nodes
};

// The texels of an RSM that reflect, in the order of their indices.
std::vector<LitTexel> lit_texels(const Rsm& rsm);

// Splits in two and again in two, along the feature that varies most, where that leaves the least spread,
// until nodes hold one texel. Equal texels are told apart by their indices: the result does not depend on the
// number of threads.
TexelTree split_texels(std::vector<LitTexel> texels);

}  // namespace vsgl
