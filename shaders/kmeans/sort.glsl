// What the passes of the radix sort share: a block's keys, SORT_RUN in a row for each invocation.
#ifndef VSGL_KMEANS_SORT_GLSL
#define VSGL_KMEANS_SORT_GLSL
#include "interop/kmeans.h"

const uint SORT_LANES = 64u;
const uint SORT_RUN = SORT_BLOCK / SORT_LANES;

layout(local_size_x = SORT_LANES) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };
layout(push_constant, scalar) uniform Push { SortPush push; };

// Keys of each digit and invocation.
shared uint digit_counts[SORT_DIGITS][SORT_LANES];

uint digit_of(uint key) { return (key >> push.shift) & (SORT_DIGITS - 1u); }

uint run_begin() { return gl_WorkGroupID.x * SORT_BLOCK + gl_LocalInvocationIndex * SORT_RUN; }
uint run_end() { return min(run_begin() + SORT_RUN, push.count); }

// Where the count of a digit in this block lies: all blocks of the first digit, all of the second, ...
uint count_index(uint digit) { return digit * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

void count_digits() {
  const uint lane = gl_LocalInvocationIndex;
  for (uint digit = 0u; digit < SORT_DIGITS; ++digit) digit_counts[digit][lane] = 0u;
  for (uint i = run_begin(); i < run_end(); ++i) ++digit_counts[digit_of(Words(push.keys_at).at[i])][lane];
  barrier();
}

#endif
