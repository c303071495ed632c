// Filters moments over kernels: each becomes a virtual light. What a light has from the surface under the kernel's centre
// (shading normal, origin, ...) is left to the caller.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "interop/light.h"
#include "interop/moments.h"
#include "interop/sampling.h"
#include "lib/lobe.glsl"
#include "lib/moments.glsl"
#include "lib/taps.glsl"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Kernels { Kernel at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Pyramid { Moments at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Lights { Light at[]; };
layout(push_constant, scalar) uniform Push {
  uvec2 kernels_at;
  uvec2 moments_at;  // the pyramid of `layer`; kernels of other layers are left alone
  uvec2 lights_at;
  uint count;
  uint layer;
  int top;               // level of one texel
  float variance_floor;  // m^2
};

Moments moments_of(int level, ivec2 texel) {
  return Pyramid(moments_at).at[pyramid_offset(1 << top, level) + uint((texel.y << (top - level)) + texel.x)];
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

// A lobe without power has neither axis nor sharpness.
SgLobe decode(vec3 power, vec3 mean, float deficit) {
  if (moments_luminance(power) <= 0.0) return SgLobe(vec3(0.0), 0.0);
  return lobe_decode(LobeMoments(mean, deficit));
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  const Kernel kernel = Kernels(kernels_at).at[i];
  if (kernel.layer != layer) return;
  const Moments moments = filter_moments(kernel);
  const SgLobe diffuse = decode(moments.power_diffuse, moments.diffuse_mean, moments.diffuse_deficit);
  const SgLobe specular = decode(moments.power_specular, moments.specular_mean, moments.specular_deficit);
  const float normal_length = length(moments.normal_mean);

  Light light = Lights(lights_at).at[i];
  light.position = moments.position;
  // [Tokuyoshi 2016, B.2]. Deviation: half of E|y - mean|^2, since the planar Gaussian of variance s has a second moment of 2 s.
  light.variance = max(0.5 * moments.spread, variance_floor);
  light.power_diffuse = kernel.power_scale * moments.power_diffuse;
  light.diffuse_sharpness = diffuse.sharpness;
  light.diffuse_axis = diffuse.axis;
  light.power_specular = kernel.power_scale * moments.power_specular;
  light.specular_sharpness = specular.sharpness;
  light.specular_axis = specular.axis;
  light.normal = normal_length > 0.0 ? moments.normal_mean / normal_length : vec3(0.0);
  light.normal_deficit = moments.normal_deficit;
  light.level = kernel.level;
  light.texel = kernel.texel;
  light.layer = layer;
  Lights(lights_at).at[i] = light;
}
