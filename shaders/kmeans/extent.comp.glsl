// Bounding box of the centres, by one workgroup.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "kmeans/tree.glsl"

const uint LANES = 256u;
layout(local_size_x = LANES) in;

shared vec3 lowest[LANES], highest[LANES];

void main() {
  const uint lane = gl_LocalInvocationIndex;
  vec3 low = Features(tree.centres_at).at[0].place, high = low;
  for (uint i = lane; i < tree.count; i += LANES) {
    const vec3 place = Features(tree.centres_at).at[i].place;
    low = min(low, place);
    high = max(high, place);
  }
  lowest[lane] = low;
  highest[lane] = high;
  barrier();
  for (uint half_count = LANES / 2u; half_count > 0u; half_count /= 2u) {
    if (lane < half_count) {
      lowest[lane] = min(lowest[lane], lowest[lane + half_count]);
      highest[lane] = max(highest[lane], highest[lane + half_count]);
    }
    barrier();
  }
  if (lane != 0u) return;
  Extent(tree.extent_at).lowest = lowest[0];
  Extent(tree.extent_at).highest = highest[0];
}
