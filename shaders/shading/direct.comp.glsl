#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Direct light of one layer of a reflective shadow map: exact emission and BRDF, shadows from the layer's depths.

#include "rsm/view.glsl"
#include "shading/exact.glsl"

layout(local_size_x = SHADING_GROUP) in;

layout(scalar, binding = 0) readonly buffer Receivers { Surface surfaces[]; };
layout(scalar, binding = 1) readonly buffer Depths { float depths[]; };  // distance to the light, m; 0: nothing
layout(scalar, binding = 2) buffer Radiance { vec3 radiance[]; };
layout(scalar, push_constant) uniform Push { DirectPush push; };

// The receiver is moved along its normal by this many texels times the sine of the angle of incidence, which clears the surface's own
// depth over the whole filter, and nearer by a relative part.
const float NORMAL_OFFSET = 2.0;
const float RELATIVE_BIAS = 1e-3;

// Place in the view, in texels, and distance as the layer stores it.
vec3 view_place(vec3 position) {
  View view = push.view;
  vec4 clip = view_clip(view, position);
  vec3 v = position - view.origin;
  float distance = view.kind == VIEW_DIRECTIONAL ? dot(v, view.forward) : length(v);
  return vec3((clip.xy / max(clip.w, 1e-18) * 0.5 + 0.5) * vec2(view.width, view.height), distance);
}

// Percentage-closer filter with the weights of a quadratic B-spline over 3x3 texels, clamped to the view.
float lit_share(vec3 place) {
  ivec2 centre = ivec2(floor(place.xy));
  vec2 f = place.xy - (vec2(centre) + 0.5);
  vec2 weights[3] = vec2[](0.5 * (0.5 - f) * (0.5 - f), 0.75 - f * f, 0.5 * (0.5 + f) * (0.5 + f));
  ivec2 last = ivec2(push.view.width, push.view.height) - 1;
  float biased = place.z * (1.0 - RELATIVE_BIAS);
  float share = 0.0;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      ivec2 t = clamp(centre + ivec2(i, j) - 1, ivec2(0), last);
      float depth = depths[uint(t.y) * push.stride + uint(t.x)];
      if (depth == 0.0 || biased <= depth) share += weights[i].x * weights[j].y;
    }
  }
  return share;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= push.receivers) return;
  Surface s = surfaces[i];
  View view = push.view;
  bool directional = view.kind == VIEW_DIRECTIONAL;
  vec3 place = view_place(s.position);
  bool in_front = directional || dot(s.position - view.origin, view.forward) > 0.0;
  bool inside = in_front && place.x >= 0.0 && place.y >= 0.0 && place.x < float(view.width) && place.y < float(view.height);
  vec3 u = directional ? -view.forward : normalize(view.origin - s.position);
  float facing = dot(s.normal, u);
  if (!inside || facing <= 0.0) return;

  float falloff = view_falloff(view, -dot(u, view.forward));
  vec3 irradiance = view.intensity * (directional ? 1.0 : falloff / (place.z * place.z));
  float texel = 2.0 * view.extent_x / float(view.width) * (directional ? 1.0 : place.z);
  vec3 moved = s.position + s.normal * (NORMAL_OFFSET * texel * sqrt(max(1.0 - facing * facing, 0.0)));
  vec2 reflection = exact_reflection(make_receiver(i, s, push.camera), u);
  radiance[i] += lit_share(view_place(moved)) * irradiance * (s.diffuse * reflection.x + s.specular * reflection.y);
}
