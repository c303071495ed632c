// Filters moments over kernels: each becomes a virtual light. What a light has from the surface under the kernel's centre
// (shading normal, origin, ...) is left to the caller.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/light.h"
#include "interop/moments.h"
#include "interop/sampling.h"
#include "lib/lobe.glsl"
#include "lib/moments.glsl"
#include "lib/taps.glsl"

layout(local_size_x = 64) in;

layout(binding = 0, scalar) readonly buffer Kernels { Kernel kernels[]; };
layout(binding = 1, scalar) readonly buffer Finest { Moments finest[]; };    // level 0
layout(binding = 2, scalar) readonly buffer Coarser { Moments coarser[]; };  // levels 1 .. top
layout(binding = 3, scalar) writeonly buffer Lights { Light lights[]; };
layout(push_constant, scalar) uniform Push {
  uint count;
  uint layer;  // whose moments are bound; kernels of other layers are left alone
  int top;
  float variance_floor;  // m^2
};

Moments moments_at(int level, ivec2 texel) {
  const uint row_major = uint((texel.y << (top - level)) + texel.x);
  if (level == 0) return finest[row_major];
  return coarser[pyramid_offset(1 << top, level) - pyramid_offset(1 << top, 1) + row_major];
}

void add_level(inout MomentsSum sum, vec2 centre, int level, float share) {
  const BilinearTaps taps = bilinear_taps(centre, 1 << (top - level));
  for (int k = 0; k < 4; ++k) {
    const float weight = share * tap_weight(taps, k);
    if (weight > 0.0) moments_add(sum, moments_at(level, tap_texel(taps, k)), weight);
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
  if (i >= count || kernels[i].layer != layer) return;
  const Kernel kernel = kernels[i];
  const Moments moments = filter_moments(kernel);
  const SgLobe diffuse = decode(moments.power_diffuse, moments.diffuse_mean, moments.diffuse_deficit);
  const SgLobe specular = decode(moments.power_specular, moments.specular_mean, moments.specular_deficit);
  const float normal_length = length(moments.normal_mean);

  lights[i].position = moments.position;
  // [Tokuyoshi 2016, B.2]. Deviation: half of E|y - mean|^2, since the planar Gaussian of variance s has a second moment of 2 s.
  lights[i].variance = max(0.5 * moments.spread, variance_floor);
  lights[i].power_diffuse = kernel.power_scale * moments.power_diffuse;
  lights[i].diffuse_sharpness = diffuse.sharpness;
  lights[i].diffuse_axis = diffuse.axis;
  lights[i].power_specular = kernel.power_scale * moments.power_specular;
  lights[i].specular_sharpness = specular.sharpness;
  lights[i].specular_axis = specular.axis;
  lights[i].normal = normal_length > 0.0 ? moments.normal_mean / normal_length : vec3(0.0);
  lights[i].normal_deficit = moments.normal_deficit;
  lights[i].level = kernel.level;
  lights[i].texel = kernel.texel;
  lights[i].layer = layer;
}
