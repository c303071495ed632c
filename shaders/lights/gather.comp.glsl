// [Tokuyoshi 2015] One step of the sum over an RSM layer: each invocation merges a block of texels, of one reflection component alone.
// Its weights are the component's own, so that position, normal and lobe are means over what that component reflects.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "lib/moments.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Fine { Moments at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Coarse { Moments at[]; };
layout(push_constant, scalar) uniform Push {
  uvec2 fine_at, coarse_at;
  uint size;      // texels a side of the coarser level
  uint block;     // texels a side of a block
  uint specular;  // 1: the specular component, 0: the diffuse one
};

Moments component_of(Moments m) {
  if (specular != 0u)
    m.power_diffuse = vec3(0.0);
  else
    m.power_specular = vec3(0.0);
  m.weight = moments_luminance(m.power_diffuse + m.power_specular);
  return m;
}

void main() {
  const uvec2 texel = gl_GlobalInvocationID.xy;
  if (texel.x >= size || texel.y >= size) return;
  MomentsSum sum = moments_start();
  const float share = 1.0 / float(block * block);
  for (uint j = 0u; j < block; ++j)
    for (uint i = 0u; i < block; ++i) {
      const uvec2 fine = texel * block + uvec2(i, j);
      moments_add(sum, component_of(Fine(fine_at).at[fine.y * size * block + fine.x]), share);
    }
  Coarse(coarse_at).at[texel.y * size + texel.x] = moments_finish(sum);
}
