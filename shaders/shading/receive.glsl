// Reflection of light that arrives as one spherical Gaussian, in the fast forms of the inner loops.
#ifndef VSGL_SHADING_RECEIVE_GLSL
#define VSGL_SHADING_RECEIVE_GLSL

#include "kernels/mixture.glsl"
#include "lib/reflected_lobe.glsl"
#include "shading/receiver.glsl"

layout(constant_id = SHADING_LOBE_ID) const uint LOBE = SPECULAR_LOBE_MIXTURE;

// The specular lobe's answer to the normalised SG, 1/sr.
float specular_answer(Receiver r, Incoming incoming) {
  if (LOBE == SPECULAR_LOBE_SG) return specular_vmf_sg(r.lobe, incoming.axis, incoming.sharpness);
  if (LOBE == SPECULAR_LOBE_ASG) return specular_vmf_asg(r.lobe, incoming.axis, incoming.sharpness);
  if (LOBE == SPECULAR_LOBE_ASG_ASG) return specular_vmf_asg_asg(r.lobe, incoming.axis, incoming.sharpness);
  if (LOBE == SPECULAR_LOBE_NDF_FILTER) return specular_vmf_ndf_filter(r.lobe, incoming.axis, incoming.sharpness);
  vec3 light = specular_local(r.lobe, incoming.axis);
  if (LOBE != SPECULAR_LOBE_BLEND) return fast_specular_mixture(r.lobe, light, incoming, r.slope_view);
  if (r.lobe.ndf == NDF_GGX) return fast_specular_ggx(r.lobe, light, incoming, r.slope_view);
  return fast_specular_gaussian(r.lobe, light, incoming);
}

// (diffuse, specular) radiance per unit of the light's peak intensity and of each reflectance.
vec2 receive(Receiver r, Incoming incoming) {
  vec2 radiance = vec2(received_cosine(incoming, dot(incoming.axis, r.normal)) * INVERSE_PI, 0.0);
  if (RECEIVER != NDF_NONE)
    radiance.y = incoming.amplitude * incoming.phi * (1.0 + incoming.decay) * specular_answer(r, incoming);
  return radiance;
}

// How much of a footprint is above the geometric horizon, beyond what the shading horizon has cut already: 1 where the normals agree.
// Its edge is a ramp of slope 0.4 in units of its standard deviation, as the normal distribution's at its centre.
float geometric_horizon(Receiver r, vec3 v, float inverse_variance) {
  float scale = 0.4 * sqrt(inverse_variance);
  vec2 heights = scale * vec2(dot(v, r.geometric), dot(v, r.normal));
  vec2 above = clamp(0.5 + heights, 0.0, 1.0);
  return min(1.0 + above.x - above.y, 1.0);
}

#endif
