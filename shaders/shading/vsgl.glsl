// Virtual spherical Gaussian lights, both formulations. A kernel defines, before including this file,
//   vec2 effective_distance2(float d2, float inverse_d, float variance),  vec2 emission_cosine(ShadingLight light, vec3 w)  and
//   const float DIFFUSE_BANDWIDTH: sharpness that bias reduction gives the receiver's diffuse lobe.
#ifndef VSGL_SHADING_VSGL_GLSL
#define VSGL_SHADING_VSGL_GLSL

#include "shading/emission.glsl"
#include "shading/receive.glsl"
#include "shading/shadow.glsl"

// [Tokuyoshi 2014, Sec. 3.3] Weight with which the SG approximation is cancelled: the light's footprint, seen as a lobe, is much
// sharper than everything it is multiplied with. 0 where bandwidth variance / d2 reaches the threshold, 1 at half of it.
// Deviation: a blend over a factor of two instead of a switch.
float cancellation(Receiver r, ShadingLight light, float inverse_d2) {
  float bandwidth = max(r.bandwidth, DIFFUSE_BANDWIDTH) + light.bandwidth;
  float ratio = push.cancel_scale * light.variance * bandwidth * inverse_d2;
  return smoothstep(0.0, 1.0, 2.0 - ratio);
}

void add_light(Receiver r, ShadingLight light, inout Sums sums) {
  vec3 v = light.position - r.position;
  float squared = dot(v, v);
  float inverse_d = inversesqrt(max(squared, 1e-24));
  vec3 u = squared > 1e-24 ? v * inverse_d : -light.diffuse_axis;  // in the light itself: where it shines from
  vec2 distance2 = effective_distance2(squared, inverse_d, light.variance);
  vec2 cosine = emission_cosine(light, -u);
  Incoming incoming =
      incoming_light(u, distance2.x, light.variance, light.inverse_variance, light.diffuse_axis, light.diffuse_sharpness);
  vec2 from_diffuse = light.diffuse_scale * cosine.x * receive(r, incoming);
  vec2 from_specular = vec2(0.0);
  if (EMISSION != NDF_NONE) {
    incoming = incoming_light(u, distance2.x, light.variance, light.inverse_variance, light.specular_axis, light.specular_sharpness);
    from_specular = light.specular_scale * cosine.y * receive(r, incoming);
  }
  float lit = visibility(r, light.index);
  float kept = lit;
  if (BUMPED != 0) kept *= geometric_horizon(r, v, light.inverse_variance);
  Transfer exact = Transfer(vec2(0.0), vec2(0.0));
  if (CANCEL != 0) {
    float cancelled = cancellation(r, light, distance2.y);
    kept *= 1.0 - cancelled;
    exact = exact_transfer(r, light, u, cancelled * lit * min(distance2.y, light.inverse_variance));
    sums.aside += luminance(r, light, exact);
  }
  add(sums, light, Transfer(kept * vec2(from_diffuse.x, from_specular.x) + exact.diffuse,
                            kept * vec2(from_diffuse.y, from_specular.y) + exact.specular));
}

#include "shading/loop.glsl"

#endif
