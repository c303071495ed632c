// Exclusive prefix sum of the counts of all digits and blocks, by one workgroup.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "interop/kmeans.h"

const uint LANES = 256u;
layout(local_size_x = LANES) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };
layout(push_constant, scalar) uniform Push { SortPush push; };

shared uint sums[LANES];

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const uint counts = SORT_DIGITS * ((push.count + SORT_BLOCK - 1u) / SORT_BLOCK);
  const uint run = (counts + LANES - 1u) / LANES;
  const uint begin = min(lane * run, counts), end = min(begin + run, counts);
  uint sum = 0u;
  for (uint i = begin; i < end; ++i) sum += Words(push.counts_at).at[i];
  sums[lane] = sum;
  barrier();
  for (uint reach = 1u; reach < LANES; reach *= 2u) {
    const uint before = lane >= reach ? sums[lane - reach] : 0u;
    barrier();
    sums[lane] += before;
    barrier();
  }
  uint running = sums[lane] - sum;
  for (uint i = begin; i < end; ++i) {
    const uint count = Words(push.counts_at).at[i];
    Words(push.counts_at).at[i] = running;
    running += count;
  }
}
