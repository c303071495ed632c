// Hemi-octahedral map of the hemisphere z >= 0 to the square [-1, 1]^2: every texel is used and borders are straight.
#ifndef VSGL_LIB_OCTAHEDRAL_GLSL
#define VSGL_LIB_OCTAHEDRAL_GLSL

// `v`: any length, v.z >= 0, not zero.
vec2 hemi_octahedral_encode(vec3 v) {
  vec2 p = v.xy / (abs(v.x) + abs(v.y) + v.z);
  return vec2(p.x + p.y, p.x - p.y);
}

// Point of the octahedron |x| + |y| + z = 1 above the square's point `e`.
vec3 hemi_octahedral_point(vec2 e) {
  vec2 p = 0.5 * vec2(e.x + e.y, e.x - e.y);
  return vec3(p, 1.0 - abs(p.x) - abs(p.y));
}

vec3 hemi_octahedral_decode(vec2 e) {
  return normalize(hemi_octahedral_point(e));
}

// Solid angle (sr) of the texel centred at `e` in a map of `size` texels a side: (2/n)^2 / (2 |P|^3). Midpoint rule: over a 64x64
// map the sum is 2 pi within 1e-4.
float hemi_octahedral_solid_angle(vec2 e, float size) {
  vec3 p = hemi_octahedral_point(e);
  float r2 = dot(p, p);
  return 2.0 / (size * size * r2 * sqrt(r2));
}

#endif
