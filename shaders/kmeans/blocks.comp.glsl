// Bounds of blocks of leaves, each from those of the step below.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "kmeans/tree.glsl"

layout(local_size_x = 64) in;

void main() {
  const uint block = gl_GlobalInvocationID.x, below = tree.step - 1u;
  if (block >= block_count(tree.step)) return;
  const uint first = block * CENTRE_BLOCK, end = min(first + CENTRE_BLOCK, block_count(below));
  CentreBlock bounds = block_at(below, first);
  for (uint i = first + 1u; i < end; ++i) bounds = join(bounds, block_at(below, i));
  Blocks(tree.blocks_at).at[blocks_begin(tree.step) + block] = bounds;
}
