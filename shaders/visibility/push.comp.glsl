// Push: the empty texels of a level above the map take their parents' distances; finer data always win.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/splat.h"
#include "lib/octahedral.glsl"
#include "visibility/pull_push.glsl"

layout(local_size_x = 64) in;

void main() {
  uint size = level_size(push.level);
  uint index = gl_GlobalInvocationID.x, view = gl_WorkGroupID.y;
  if (index >= size * size) return;
  uvec2 texel = uvec2(index % size, index / size);
  uint address = level_address(push.level, view, texel);
  if (levels[address] == 0.0) levels[address] = pushed_distance(push.level, view, texel);
}
