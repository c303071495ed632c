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

// BRDF times cosine towards `w`, per component of reflectance.
vec3 reflect_towards(Reflector r, vec3 w, bool specular) {
  vec3 value = r.diffuse * max(dot(r.normal, w), 0.0) / PI;
  if (specular && r.ndf != NDF_NONE)
    value += r.specular * specular_brdf_cos(r.ndf, r.alpha, r.shading_normal, r.incident, w);
  return value;
}

float importance(Reflector texel, Reflector pixel) {
  const vec3 v = pixel.position - texel.position;
  const float d2 = dot(v, v);
  const vec3 w = v * inversesqrt(max(d2, 1e-36));
  return dot(reflect_towards(texel, w, SPECULAR_TEXELS != 0u), reflect_towards(pixel, -w, SPECULAR_SOURCES != 0u)) /
         max(d2, push.distance2);
}

#include "pdf/loop.glsl"
