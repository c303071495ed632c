// How many keys of each digit a block holds.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "kmeans/sort.glsl"

void main() {
  count_digits();
  const uint digit = gl_LocalInvocationIndex;
  if (digit >= SORT_DIGITS) return;
  uint sum = 0u;
  for (uint lane = 0u; lane < SORT_LANES; ++lane) sum += digit_counts[digit][lane];
  Words(push.counts_at).at[count_index(digit)] = sum;
}
