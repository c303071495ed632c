// Visibility of a light: from its shadow map, or exactly.
#ifndef VSGL_SHADING_SHADOW_GLSL
#define VSGL_SHADING_SHADOW_GLSL

#include "lib/octahedral.glsl"
#include "shading/common.glsl"

float shadow_texel(uint corner, ivec2 texel) {
  ivec2 t = clamp(texel, ivec2(0), ivec2(push.tile - 1));
  return inverse_distance[corner + uint(t.y) * push.columns * push.tile + uint(t.x)];
}

// Share of the light that arrives, 0..1: 2x2 percentage-closer filtering with bilinear weights, clamped to the light's tile. 0 outside
// the light's hemisphere. [Ritschel 2008] with a hemi-octahedral tile.
// Bias: the receiver is moved along its normal by `normal_offset` texels, less where it faces the light, and nearer by a relative part,
// by `slope_bias` texels per tangent (at most 1.5: more leaks behind thin walls) and by `disk_bias`.
float map_visibility(Receiver r, uint index) {
  ShadingView view = views[index];
  mat3 frame = frame_about(view.axis);
  vec3 v = r.position - view.origin;
  float d = length(v);
  float size = float(push.tile);
  vec3 u = v * frame;
  vec2 e = hemi_octahedral_encode(u / max(d, 1e-18));
  float texel = sqrt(hemi_octahedral_solid_angle(e, size));
  float c = abs(dot(r.geometric, v)) / max(d, 1e-18);
  float s = sqrt(max(1.0 - c * c, 0.0));

  vec3 w = (v + r.geometric * (push.normal_offset * d * texel * s)) * frame;
  float distance = length(w);
  float biased = distance * (1.0 - push.relative_bias - push.slope_bias * texel * min(s / max(c, 1e-6), 1.5)) - push.disk_bias;
  vec2 p = (hemi_octahedral_encode(w) * 0.5 + 0.5) * size - 0.5;
  ivec2 base = ivec2(floor(p));
  vec2 f = p - floor(p);
  uint corner = ((index / push.columns - push.first_row) * push.columns * push.tile + index % push.columns) * push.tile;
  vec4 nearest = vec4(shadow_texel(corner, base), shadow_texel(corner, base + ivec2(1, 0)),
                      shadow_texel(corner, base + ivec2(0, 1)), shadow_texel(corner, base + ivec2(1, 1)));
  // Lit where biased <= distance in the map; an empty texel (0) always is.
  vec4 lit = vec4(lessThanEqual(nearest * biased, vec4(1.0)));
  float share = mix(mix(lit.x, lit.y, f.x), mix(lit.z, lit.w, f.x), f.y);
  // Both: the light's own surface, moved along its normal, would see itself.
  return min(u.z, w.z) > 0.0 ? share : 0.0;
}

// Share of the light that arrives at the receiver, 0..1.
float visibility(Receiver r, uint index) {
  if (SHADOWS == VISIBILITY_NONE) return 1.0;
  if (SHADOWS == VISIBILITY_MAPS) return map_visibility(r, index);
  uint word = visibility_words[(index / 32 - push.first_word) * push.receivers + r.place];
  return float((word >> (index % 32)) & 1u);
}

#endif
