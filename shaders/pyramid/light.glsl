// A virtual light from the moments of a cluster.
#ifndef VSGL_PYRAMID_LIGHT_GLSL
#define VSGL_PYRAMID_LIGHT_GLSL

#include "interop/light.h"
#include "interop/moments.h"
#include "lib/lobe.glsl"
#include "lib/moments.glsl"

// A lobe without power has neither axis nor sharpness. lobe_filter: LOBE_*, how the moments are encoded.
SgLobe decode_lobe(uint lobe_filter, vec3 power, vec3 mean, float deficit) {
  if (moments_luminance(power) <= 0.0) return SgLobe(vec3(0.0), 0.0);
  return lobe_decode_by(lobe_filter, LobeMoments(mean, deficit));
}

// Without filtering one texel's own lobes stand for all, those of the mean where it has none.
void take_lobes(inout Moments moments, Moments own) {
  if (own.diffuse_mean != vec3(0.0)) {
    moments.diffuse_mean = own.diffuse_mean;
    moments.diffuse_deficit = own.diffuse_deficit;
  }
  if (own.specular_mean != vec3(0.0)) {
    moments.specular_mean = own.specular_mean;
    moments.specular_deficit = own.specular_deficit;
  }
}

// Sets what a light has from `moments`, with powers times `power_scale`; the other members stay as they are.
// variance_floor: m^2.
void set_moments(inout Light light, Moments moments, float power_scale, float variance_floor, uint lobe_filter) {
  const SgLobe diffuse = decode_lobe(lobe_filter, moments.power_diffuse, moments.diffuse_mean, moments.diffuse_deficit);
  const SgLobe specular = decode_lobe(lobe_filter, moments.power_specular, moments.specular_mean, moments.specular_deficit);
  const float normal_length = length(moments.normal_mean);
  light.position = moments.position;
  // [Tokuyoshi 2016, B.2]. Deviation: half of E|y - mean|^2, since the planar Gaussian of variance s has a second moment of 2 s.
  light.variance = max(0.5 * moments.spread, variance_floor);
  light.power_diffuse = power_scale * moments.power_diffuse;
  light.diffuse_sharpness = diffuse.sharpness;
  light.diffuse_axis = diffuse.axis;
  light.power_specular = power_scale * moments.power_specular;
  light.specular_sharpness = specular.sharpness;
  light.specular_axis = specular.axis;
  light.normal = normal_length > 0.0 ? moments.normal_mean / normal_length : vec3(0.0);
  light.normal_deficit = moments.normal_deficit;
}

#endif
