// [Ritschel 2011] bidirectional importance from view samples: each lit texel is a virtual point light that shades them.
// Without visibility; the squared distance is floored.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

#define SOURCE Reflector
#define TEXEL Reflector
#include "pdf/importance.glsl"

Reflector make_texel(Reflector r) { return r; }

// BRDF times cosine towards `w`, per component of reflectance. `kind`: NDF of all that are specular, a constant.
vec3 reflect_towards(Reflector r, vec3 w, uint kind) {
  vec3 value = r.diffuse * max(dot(r.normal, w), 0.0) / PI;
  if (kind == NDF_NONE) return value;
  return value + r.specular * specular_brdf_cos(kind == IMPORTANCE_NDF_ANY ? r.ndf : kind, r.alpha, r.shading_normal, r.incident, w);
}

float importance(Reflector texel, Reflector pixel) {
  const vec3 v = pixel.position - texel.position;
  const float d2 = dot(v, v);
  const vec3 w = v * inversesqrt(max(d2, 1e-36));
  return dot(reflect_towards(texel, w, TEXEL_NDF), reflect_towards(pixel, -w, SOURCE_NDF)) / max(d2, push.distance2);
}

#include "pdf/loop.glsl"
