// The first centres: texels.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "interop/kmeans.h"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
  Texels texels;
  uvec2 chosen_at;   // uint per cluster: its texel
  uvec2 centres_at;  // Feature per cluster
};
#include "kmeans/texels.glsl"

void main() {
  const uint cluster = gl_GlobalInvocationID.x;
  if (cluster >= texels.clusters) return;
  const uint texel = Words(chosen_at).at[cluster];
  const Moments m = texel_moments(texel);
  Features(centres_at).at[cluster] = texel_feature(texel, m.position, m.normal_mean);
}
