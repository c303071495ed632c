// Bounds of the inner nodes, from the largest blocks that make up their leaves.
// Deviation from [Karras 2012], where the leaves climb and the second child to arrive at a node goes on: here no invocation waits for what
// another one writes.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "kmeans/tree.glsl"

layout(local_size_x = 64) in;

void main() {
  const uint node = gl_GlobalInvocationID.x;
  if (node + 1u >= tree.count) return;
  const uint first = Nodes(tree.nodes_at).at[node].first, end = Nodes(tree.nodes_at).at[node].last + 1u;
  CentreBlock bounds = block_at(0u, first);
  for (uint leaf = first; leaf < end;) {
    uint step = 0u, leaves = 1u;
    while (leaf % (leaves * CENTRE_BLOCK) == 0u && leaf + leaves * CENTRE_BLOCK <= end) {
      leaves *= CENTRE_BLOCK;
      ++step;
    }
    bounds = join(bounds, block_at(step, leaf / leaves));
    leaf += leaves;
  }
  Nodes(tree.nodes_at).at[node].low = bounds.low;
  Nodes(tree.nodes_at).at[node].high = bounds.high;
}
