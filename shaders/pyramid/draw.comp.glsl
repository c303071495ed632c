// Draws filter kernels: points of the unit square, warped by the density, with the size of the kernel about each.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "interop/sampling.h"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Density { float at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Kernels { Kernel at[]; };
layout(push_constant, scalar) uniform Push {
  uvec2 densities_at;  // the layers' mean pyramids, one after another
  uvec2 kernels_at;
  PointSet points;
  uint rule;    // KERNEL_*
  uint layers;
  int top;      // level of one texel
  float scale;  // K
};

#include "lib/kernel_size.glsl"

float density_at(uint layer, int level, ivec2 texel) {
  const uint layer_texels = pyramid_offset(1 << top, top) + 1u;
  return Density(densities_at).at[layer * layer_texels + pyramid_offset(1 << top, level) + uint((texel.y << (top - level)) + texel.x)];
}

// Texels that the kernel's mean stands for: with M texels in all, M / (N p).
// [Tokuyoshi 2016, Eq. (5)] p is filtered by the kernel itself; Eq. (4), the older form: p at its centre, N p at least 1.
float power_scale(float texels, float p) {
  const float samples = float(points.count) * p;
  if (rule == KERNEL_DENSITY) return texels / max(samples, 1.0);
  return samples > 0.0 ? texels / samples : 0.0;
}

float kernel_level(uint layer, vec2 centre, float p, float texels) {
  const float share = scale / float(points.count);
  switch (rule) {
    case KERNEL_DENSITY: return kernel_level_density(p, top, texels, share);
    case KERNEL_NEWTON: return kernel_level_newton(layer, top, centre, texels, share);
    case KERNEL_BISECTION: return kernel_level_bisection(layer, top, centre, texels, share, 12);
    default: return 0.0;
  }
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= points.count) return;
  vec2 point = point_of_bits(point_bits(points, i));
  const float texels = float(layers) * exp2(2.0 * float(top));

  Kernel kernel;
  kernel.layer = warp_layer(layers, top, point.x);
  const ivec2 texel = warp_texel(kernel.layer, top, point);
  kernel.texel = uint((texel.y << top) + texel.x);
  // The texel itself, exactly: no filter weight falls on its neighbours.
  if (rule == KERNEL_TEXEL) point = vec2(0.5);
  kernel.centre = (vec2(texel) + point) * exp2(-float(top));
  float p = density_at(kernel.layer, 0, texel);
  kernel.level = kernel_level(kernel.layer, kernel.centre, p, texels);
  if (rule == KERNEL_NEWTON || rule == KERNEL_BISECTION)
    p = density_trilinear(kernel.layer, kernel.level, top, kernel.centre);
  kernel.power_scale = power_scale(texels, p);
  Kernels(kernels_at).at[i] = kernel;
}
