// Test shader: every kind of binding at once. sums[i] = dot(weights, texels[indices[i]]).
#version 450
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

layout(binding = 0) uniform samplerBuffer texels;
layout(binding = 1) uniform usamplerBuffer indices;
layout(binding = 2, scalar) uniform Weights { vec4 weights; };
layout(binding = 3, scalar) writeonly buffer Sums { float sums[]; };

void main() {
  const int i = int(gl_GlobalInvocationID.x);
  if (i < textureSize(indices)) sums[i] = dot(weights, texelFetch(texels, int(texelFetch(indices, i).x)));
}
