// Encodes the lobes of a moment pyramid's finest level anew: from LOBE_BANERJEE, which a texel's single lobe survives, by another map.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "interop/moments.h"
#include "lib/lobe.glsl"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Texels { Moments at[]; };
layout(push_constant, scalar) uniform Push {
  uvec2 texels_at;
  uint count;
  uint lobe_filter;  // LOBE_*
};

// Texels without a lobe stay as they are.
LobeMoments encode_anew(vec3 mean, float deficit) {
  const LobeMoments moments = LobeMoments(mean, deficit);
  if (mean == vec3(0.0)) return moments;
  const SgLobe lobe = lobe_decode(moments);
  return lobe_encode_by(lobe_filter, lobe.axis, lobe.sharpness);
}

void main() {
  const uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  if (i >= count) return;
  Texels texels = Texels(texels_at);
  const LobeMoments diffuse = encode_anew(texels.at[i].diffuse_mean, texels.at[i].diffuse_deficit);
  const LobeMoments specular = encode_anew(texels.at[i].specular_mean, texels.at[i].specular_deficit);
  texels.at[i].diffuse_mean = diffuse.mean;
  texels.at[i].diffuse_deficit = diffuse.deficit;
  texels.at[i].specular_mean = specular.mean;
  texels.at[i].specular_deficit = specular.deficit;
}
