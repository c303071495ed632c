// The filter kernel about a point, by one of the rules KERNEL_*. The includer declares `KernelSetup setup` among its push constants.
#ifndef VSGL_PYRAMID_KERNEL_GLSL
#define VSGL_PYRAMID_KERNEL_GLSL
#include "lib/kernel_size.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Density { float at[]; };

float density_at(uint layer, int level, ivec2 texel) {
  const int top = int(setup.top);
  const uint layer_texels = pyramid_offset(1 << top, top) + 1u;
  return Density(setup.densities_at).at[layer * layer_texels + pyramid_offset(1 << top, level) + uint((texel.y << (top - level)) + texel.x)];
}

// Texels that the kernel's mean stands for: with M texels in all, M / (N p).
// [Tokuyoshi 2016, Eq. (5)] p is filtered by the kernel itself; Eq. (4), the older form: p at its centre, N p at least 1.
float power_scale(float texels, float p) {
  const float samples = float(setup.points.count) * p;
  if (setup.rule == KERNEL_DENSITY) return texels / max(samples, 1.0);
  return samples > 0.0 ? texels / samples : 0.0;
}

float kernel_level(uint layer, vec2 centre, float p, float texels) {
  const float share = setup.scale / float(setup.points.count);
  switch (setup.rule) {
    case KERNEL_DENSITY: return kernel_level_density(p, int(setup.top), texels, share);
    case KERNEL_NEWTON: return kernel_level_newton(layer, int(setup.top), centre, texels, share);
    case KERNEL_BISECTION: return kernel_level_bisection(layer, int(setup.top), centre, texels, share, 12);
    default: return 0.0;
  }
}

// About a point, [0, 1)^2, of a texel.
Kernel kernel_about(uint layer, ivec2 texel, vec2 point) {
  const int top = int(setup.top);
  const float texels = float(setup.layers) * exp2(2.0 * float(top));
  // The texel itself, exactly: no filter weight falls on its neighbours.
  if (setup.rule == KERNEL_TEXEL) point = vec2(0.5);
  Kernel kernel;
  kernel.layer = layer;
  kernel.texel = uint((texel.y << top) + texel.x);
  kernel.centre = (vec2(texel) + point) * exp2(-float(top));
  float p = density_at(layer, 0, texel);
  kernel.level = kernel_level(layer, kernel.centre, p, texels);
  if (setup.rule == KERNEL_NEWTON || setup.rule == KERNEL_BISECTION)
    p = density_trilinear(layer, kernel.level, top, kernel.centre);
  kernel.power_scale = power_scale(texels, p);
  return kernel;
}

#endif
