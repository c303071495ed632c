#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Virtual point lights with the true BRDFs at both ends.

#include "shading/emission.glsl"
#include "shading/shadow.glsl"

// [Keller 1997] L = power f_y f_x cos cos / d^2.
// Deviation: d^2 is floored, and the light that the floor takes away is counted. A light in the pixel itself gives nothing.
void add_light(Receiver r, ShadingLight light, inout Sums sums) {
  vec3 v = light.position - r.position;
  float d2 = dot(v, v);
  bool apart = d2 > 1e-18;
  vec3 u = v * inversesqrt(max(d2, 1e-18));
  float lit = apart ? visibility(r, light.index) : 0.0;
  float floored = lit / max(max(d2, push.clamp_distance2), 1e-18);
  Transfer t = exact_transfer(r, light, u, floored);
  add(sums, light, t);
  sums.aside += luminance(r, light, t) * max(push.clamp_distance2 / max(d2, 1e-18) - 1.0, 0.0);
}

#include "shading/loop.glsl"
