// Filters moments over kernels: each becomes a virtual light. What a light has from the surface under the kernel's centre
// (shading normal, origin, ...) is left to the caller.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "interop/sampling.h"
#include "lib/taps.glsl"
#include "pyramid/light.glsl"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Kernels { Kernel at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Pyramid { Moments at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Lights { Light at[]; };
layout(push_constant, scalar) uniform Push {
  uvec2 kernels_at;
  uvec2 finest_at;   // level 0 of the pyramid of `layer`; kernels of other layers are left alone
  uvec2 coarser_at;  // its other levels
  uvec2 lights_at;
  uint count;
  uint layer;
  int top;               // level of one texel
  float variance_floor;  // m^2
  uint lobe_filter;      // LOBE_*: how the lobes of the pyramid are encoded
};

Moments moments_of(int level, ivec2 texel) {
  const uint i = uint((texel.y << (top - level)) + texel.x);
  return level == 0 ? Pyramid(finest_at).at[i] : Pyramid(coarser_at).at[pyramid_offset(1 << (top - 1), level - 1) + i];
}

void add_level(inout MomentsSum sum, vec2 centre, int level, float share) {
  const BilinearTaps taps = bilinear_taps(centre, 1 << (top - level));
  for (int k = 0; k < 4; ++k) {
    const float weight = share * tap_weight(taps, k);
    if (weight > 0.0) moments_add(sum, moments_of(level, tap_texel(taps, k)), weight);
  }
}

// The trilinear look-up: eight taps, merged by the law of total variance like a mip step.
Moments filter_moments(Kernel kernel) {
  MomentsSum sum = moments_start();
  const int level = min(int(kernel.level), top);
  const float blend = level < top ? kernel.level - float(level) : 0.0;
  add_level(sum, kernel.centre, level, 1.0 - blend);
  if (blend > 0.0) add_level(sum, kernel.centre, level + 1, blend);
  return moments_finish(sum);
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  const Kernel kernel = Kernels(kernels_at).at[i];
  if (kernel.layer != layer) return;
  Light light = Lights(lights_at).at[i];
  Moments moments = filter_moments(kernel);
  if (lobe_filter == LOBE_NONE) take_lobes(moments, Pyramid(finest_at).at[kernel.texel]);
  set_moments(light, moments, kernel.power_scale, variance_floor, lobe_filter);
  light.level = kernel.level;
  light.texel = kernel.texel;
  light.layer = layer;
  Lights(lights_at).at[i] = light;
}
