// Pull: each texel of level + 1 gets the distance that most of its valid children agree on.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/splat.h"
#include "lib/octahedral.glsl"
#include "visibility/pull_push.glsl"

layout(local_size_x = 64) in;

void main() {
  uint size = level_size(push.level + 1u);
  uint index = gl_GlobalInvocationID.x, view = gl_WorkGroupID.y;
  if (index >= size * size) return;
  uvec2 parent = uvec2(index % size, index / size);
  vec4 d;
  for (uint i = 0u; i < 4u; ++i) d[i] = distance_at(push.level, view, 2u * parent + uvec2(i & 1u, i >> 1u));
  vec4 weight = vec4(greaterThan(d, vec4(0.0)));
  // A lone splat in a block of the map is no surface.
  float needed = push.level == 0u ? 2.0 : 1.0;
  bool valid = dot(weight, vec4(1.0)) >= needed;
  levels[level_address(push.level + 1u, view, parent)] = valid ? majority_mean(d, weight, push.level) : 0.0;
}
