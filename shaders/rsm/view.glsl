// Rays and clip coordinates of a view, and the light that it sends along its rays.
#ifndef VSGL_RSM_VIEW_GLSL
#define VSGL_RSM_VIEW_GLSL

#include "interop/geometry.h"

struct Ray {
  vec3 origin, direction;  // direction not normalised: its component along `forward` is 1
};

// Coordinates on the plane at distance 1 (directional: on the near plane, m) of `p`, in texels from the top-left corner.
vec2 view_plane(View view, vec2 p) {
  vec2 ndc = 2.0 * p / vec2(view.width, view.height) - 1.0;
  return vec2(ndc.x * view.extent_x, -ndc.y * view.extent_y);
}

Ray view_ray(View view, vec2 p) {
  vec2 q = view_plane(view, p);
  vec3 offset = q.x * view.right + q.y * view.up;
  return view.kind == VIEW_DIRECTIONAL ? Ray(view.origin + offset, view.forward)
                                       : Ray(view.origin, view.forward + offset);
}

// Area of a texel on that plane.
float view_texel_area(View view) {
  return 4.0 * view.extent_x * view.extent_y / (float(view.width) * float(view.height));
}

// Reversed depth: 1 at the near plane, 0 at infinity (directional: at the far plane).
vec4 view_clip(View view, vec3 position) {
  vec3 v = position - view.origin;
  float x = dot(v, view.right) / view.extent_x;
  float y = -dot(v, view.up) / view.extent_y;
  float along = dot(v, view.forward);
  return view.kind == VIEW_DIRECTIONAL ? vec4(x, y, 1.0 - along / view.near_far, 1.0)
                                       : vec4(x, y, view.near_far, along);
}

// Spot fall-off of KHR_lights_punctual; a hard edge when both cones agree.
float view_falloff(View view, float cosine) {
  if (view.kind != VIEW_SPOT) return 1.0;
  if (view.cos_inner <= view.cos_outer) return cosine >= view.cos_outer ? 1.0 : 0.0;
  float t = clamp((cosine - view.cos_outer) / max(1e-3, view.cos_inner - view.cos_outer), 0.0, 1.0);
  return t * t;
}

// [Dachsbacher 2005] Flux (W) through a texel, all of which lands on the surface that the texel sees: there is no surface cosine.
// Midpoint rule over samples_x samples_y points: relative error of the sum over a view below 1e-4.
vec3 view_flux(View view, uvec2 texel) {
  if (view.kind == VIEW_DIRECTIONAL) return view.intensity * view_texel_area(view);
  float sum = 0.0;
  for (uint j = 0u; j < view.samples_y; ++j) {
    for (uint i = 0u; i < view.samples_x; ++i) {
      vec2 q = view_plane(view, vec2(texel) + (vec2(i, j) + 0.5) / vec2(view.samples_x, view.samples_y));
      float cosine = inversesqrt(1.0 + dot(q, q));
      sum += view_falloff(view, cosine) * cosine * cosine * cosine;
    }
  }
  return view.intensity * (sum * view_texel_area(view) / float(view.samples_x * view.samples_y));
}

#endif
