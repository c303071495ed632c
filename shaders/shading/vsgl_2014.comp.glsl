#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// [Tokuyoshi 2014, Sec. 3.1] A uniform disk whose cone of directions is an SG of amplitude 2; the emitter's cosine is pulled out and
// its diffuse lobe has sharpness 0.

#include "shading/common.glsl"

// Diffuse lobes have sharpness 0 in this formulation.
const float DIFFUSE_BANDWIDTH = 0.0;

// Half of s (s + d), s = sqrt(d^2 + r^2), r^2 = 4 variance: over the variance it is the sharpness 4 pi / Omega of the cone's SG, and its
// inverse is Omega / (pi r^2).
vec2 effective_distance2(float d2, float inverse_d, float variance) {
  float s = sqrt(d2 + 4.0 * variance);
  float effective = 0.5 * s * (s + d2 * inverse_d);
  return vec2(effective, 1.0 / effective);
}

// specular_scale holds 1 / cosine at the lobe's own axis, so that a sharp lobe keeps its power.
vec2 emission_cosine(ShadingLight light, vec3 w) {
  return vec2(max(dot(light.normal, w), 0.0));
}

#include "shading/vsgl.glsl"
