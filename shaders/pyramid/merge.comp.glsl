// One step of the moment pyramid: each texel of the coarser level from its block of four.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "lib/moments.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Fine { Moments at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Coarse { Moments at[]; };

layout(push_constant, scalar) uniform Push { MergePush push; };

void main() {
  uvec2 texel = gl_GlobalInvocationID.xy;
  if (texel.x >= push.size || texel.y >= push.size) return;
  uint stride = 2u * push.size;
  uint first = 2u * texel.y * stride + 2u * texel.x;
  Fine fine = Fine(push.fine_at);
  Moments taps[4] = {fine.at[first], fine.at[first + 1u], fine.at[first + stride], fine.at[first + stride + 1u]};
  Coarse(push.coarse_at).at[texel.y * push.size + texel.x] = moments_merge(taps);
}
