// The last step of pull-push, per 2x2 block of the map: empty texels are filled from level 1; in a full block a
// texel that looks past three near ones of the same surface is a hole, and closed.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/splat.h"
#include "lib/octahedral.glsl"
#include "visibility/pull_push.glsl"

layout(local_size_x = 64) in;
layout(binding = 2, scalar) buffer Counts { uvec2 counts[]; };  // per view: texels filled, texels replaced

// The texel to be closed, or 4: the other three must lie within one surface's span, and it well behind them.
int hole_of(vec4 d) {
  float nearest = min(min(d.x, d.y), min(d.z, d.w));
  vec4 is_near = vec4(lessThanEqual(d, vec4(near_limit(nearest, 0u))));
  if (dot(is_near, vec4(1.0)) != 3.0) return 4;
  int hole = is_near.x == 0.0 ? 0 : is_near.y == 0.0 ? 1 : is_near.z == 0.0 ? 2 : 3;
  return d[hole] > nearest * (1.0 + 4.0 * PULL_PUSH_NEAR) ? hole : 4;
}

void main() {
  uint size = level_size(1u);
  uint index = gl_GlobalInvocationID.x, view = gl_WorkGroupID.y;
  if (index >= size * size) return;
  uvec2 corner = 2u * uvec2(index % size, index / size);
  vec4 d;
  for (uint i = 0u; i < 4u; ++i) d[i] = map_distance(view, corner + uvec2(i & 1u, i >> 1u));
  bool full = all(greaterThan(d, vec4(0.0)));
  int hole = full ? hole_of(d) : 4;
  uint filled = 0u;
  for (int i = 0; i < 4; ++i) {
    uvec2 texel = corner + uvec2(i & 1, i >> 1);
    float closed = i == hole ? (dot(d, vec4(1.0)) - d[i]) / 3.0
                   : d[i] == 0.0 ? pushed_distance(0u, view, texel)
                                 : 0.0;
    if (closed == 0.0) continue;
    maps[map_address(view, texel)] = floatBitsToUint(1.0 / closed);
    if (i != hole) ++filled;
  }
  if (filled > 0u) atomicAdd(counts[view].x, filled);
  if (hole < 4) atomicAdd(counts[view].y, 1u);
}
