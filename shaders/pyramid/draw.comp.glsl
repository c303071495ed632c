// Draws filter kernels: points of the unit square, warped by the density, with the size of the kernel about each.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "interop/kernel_setup.h"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Kernels { Kernel at[]; };
layout(push_constant, scalar) uniform Push {
  KernelSetup setup;
  uvec2 kernels_at;
};

#include "pyramid/kernel.glsl"

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= setup.points.count) return;
  vec2 point = point_of_bits(point_bits(setup.points, i));
  const uint layer = warp_layer(setup.layers, int(setup.top), point.x);
  const ivec2 texel = warp_texel(layer, int(setup.top), point);
  Kernels(kernels_at).at[i] = kernel_about(layer, texel, point);
}
