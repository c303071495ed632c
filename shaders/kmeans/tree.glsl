// What the steps that build the tree over the centres share.
#ifndef VSGL_KMEANS_TREE_GLSL
#define VSGL_KMEANS_TREE_GLSL
#include "interop/kmeans.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Features { Feature at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Extent { vec3 lowest, highest; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Nodes { CentreNode at[]; };
layout(push_constant, scalar) uniform Push { CentreTree tree; };

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Blocks { CentreBlock at[]; };

// How many blocks of step k there are: the last one may lack leaves; and where they begin. Step 0: the leaves themselves.
uint block_count(uint step) {
  uint count = tree.count;
  for (uint k = 0u; k < step; ++k) count = (count + CENTRE_BLOCK - 1u) / CENTRE_BLOCK;
  return count;
}
uint blocks_begin(uint step) {
  uint begin = 0u;
  for (uint k = 1u; k < step; ++k) begin += block_count(k);
  return begin;
}

uint leaf_node(uint leaf) { return tree.count - 1u + leaf; }

CentreBlock block_at(uint step, uint block) {
  if (step > 0u) return Blocks(tree.blocks_at).at[blocks_begin(step) + block];
  const Feature centre = Nodes(tree.nodes_at).at[leaf_node(block)].low;
  return CentreBlock(centre, centre);
}

CentreBlock join(CentreBlock a, CentreBlock b) {
  return CentreBlock(Feature(min(a.low.place, b.low.place), min(a.low.facing, b.low.facing)),
                     Feature(max(a.high.place, b.high.place), max(a.high.facing, b.high.facing)));
}

#endif
