// Morton codes of the centres in their bounding box, ten bits an axis.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "kmeans/tree.glsl"

layout(local_size_x = 64) in;

// Puts two zeros between the ten lowest bits.
uint spread_bits(uint v) {
  v = (v | (v << 16u)) & 0x030000FFu;
  v = (v | (v << 8u)) & 0x0300F00Fu;
  v = (v | (v << 4u)) & 0x030C30C3u;
  return (v | (v << 2u)) & 0x09249249u;
}

uint morton_code(vec3 place, vec3 low, vec3 high) {
  const vec3 extent = high - low;
  uint code = 0u;
  for (int axis = 0; axis < 3; ++axis) {
    const float share = extent[axis] > 0.0 ? (place[axis] - low[axis]) / extent[axis] : 0.0;
    code |= spread_bits(min(uint(share * 1024.0), 1023u)) << axis;
  }
  return code;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= tree.count) return;
  Extent extent = Extent(tree.extent_at);
  Words(tree.codes_at).at[i] = morton_code(Features(tree.centres_at).at[i].place, extent.lowest, extent.highest);
  Words(tree.order_at).at[i] = i;
}
