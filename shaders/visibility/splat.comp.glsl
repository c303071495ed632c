// [Ritschel 2008] splats the points of each light into its imperfect shadow map: one workgroup a light.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/splat.h"
#include "lib/frame.glsl"
#include "lib/octahedral.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { SplatPush push; };
layout(binding = 2, scalar) readonly buffer Points { SplatPoint points[]; };
#include "visibility/splat.glsl"

void main() {
  uint index = gl_WorkGroupID.x;
  SplatView view = views[index];
  mat3 frame = frame_about(view.axis);
  for (uint t = gl_LocalInvocationID.x; t < push.points_per_view; t += gl_WorkGroupSize.x)
    splat_point(index * push.tile * push.tile, view, frame, points[(view.first_point + t) % push.pool_size]);
}
