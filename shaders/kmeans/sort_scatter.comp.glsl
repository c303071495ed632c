// Moves a block's pairs behind those of smaller digits, and of equal digits further ahead. Ranks come from counts in the order of
// the keys, so that equal keys keep their order.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "kmeans/sort.glsl"

// From counts to the places of each invocation's first keys.
void place_digits(uint digit) {
  uint running = Words(push.counts_at).at[count_index(digit)];
  for (uint lane = 0u; lane < SORT_LANES; ++lane) {
    const uint count = digit_counts[digit][lane];
    digit_counts[digit][lane] = running;
    running += count;
  }
}

void main() {
  count_digits();
  const uint lane = gl_LocalInvocationIndex;
  if (lane < SORT_DIGITS) place_digits(lane);
  barrier();
  for (uint i = run_begin(); i < run_end(); ++i) {
    const uint key = Words(push.keys_at).at[i];
    const uint place = digit_counts[digit_of(key)][lane]++;
    Words(push.sorted_keys_at).at[place] = key;
    Words(push.sorted_values_at).at[place] = Words(push.values_at).at[i];
  }
}
