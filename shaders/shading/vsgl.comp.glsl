#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// [Tokuyoshi 2016, Sec. 3 and App. C] A Gaussian footprint with SG emission; the light that arrives is one SG per emission lobe.

#include "shading/common.glsl"

// The receiver's cosine counts as the SG that stands for a Lambert lobe.
const float DIFFUSE_BANDWIDTH = LAMBDA_DIFFUSE;

// The squared distance that over the variance is the sharpness of the footprint as seen from the pixel, and its inverse.
vec2 effective_distance2(float d2, float inverse_d, float variance) {
  return vec2(d2, inverse_d * inverse_d);
}

// The emission SGs hold the emitter's cosine.
vec2 emission_cosine(ShadingLight light, vec3 w) {
  return vec2(1.0);
}

#include "shading/vsgl.glsl"
