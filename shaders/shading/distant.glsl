// Reflection of footprints far away: exact, with the specular lobe spread by the footprint.
#ifndef VSGL_SHADING_DISTANT_GLSL
#define VSGL_SHADING_DISTANT_GLSL

#include "lib/fvpl.glsl"
#include "shading/exact.glsl"

// Specular BRDF times cosine, 1/sr, with half vectors spread as the footprint's directions are, whose variance is 1 / sharpness per axis:
// that adds 1 / (2 sharpness) to alpha^2 in the plane of incidence and 1 / (2 sharpness cos^2) across it. The geometric mean of both keeps
// the peak. `light`: direction to the footprint, local.
float distant_specular(Receiver r, vec3 light, float inverse_sharpness) {
  float alpha2 = r.lobe.alpha2;
  float spread = min(0.5 * inverse_sharpness / r.lobe.cos_view, 1.0);
  vec3 h = vec3(r.lobe.sin_view, 0.0, r.lobe.cos_view) + light;
  float sin2 = h.x * h.x + h.y * h.y;
  float cos2 = h.z * h.z;
  float c = max(light.z, 0.0);
  if (r.lobe.ndf != NDF_GGX)
    return exact_specular(r.lobe.ndf, min(alpha2 + spread, 1.0), r.lobe.cos_view, r.slope_view, r.lobe.view_lambda, c, c, sin2, cos2);
  // ggx_spread_d() of lib/fvpl.glsl.
  float hh = max(sin2 + cos2, 1e-8);
  float b = alpha2 + sqrt(2.0 * spread * (alpha2 + 2.0 * spread));
  float q = max(sin2 + b * cos2, min(b, 1.0) * hh);
  float masking = r.slope_view * c + ggx_slope_cosine(alpha2, c) * r.lobe.cos_view;
  float inverse = 1.0 / (q * masking);
  float inverse_q = inverse * masking;
  float sharp = hh * inverse_q;
  float density = sharp * sharp * (alpha2 + 2.0 * b * (b - alpha2) * cos2 * inverse_q);
  return c > 0.0 ? 0.5 * INVERSE_PI * density * c * (inverse * q) : 0.0;
}

// As exact_reflection(), of a flat cluster.
vec2 distant_reflection(Receiver r, Cluster c, vec3 u, float inverse_sharpness) {
  float above = BUMPED == 0 || dot(r.geometric, u) > 0.0 ? 1.0 : 0.0;
  float cosine = max(dot(r.normal, u), 0.0);
  vec2 reflection = vec2(above * INVERSE_PI * cosine * fvpl_plane(c, u, r.normal, cosine, inverse_sharpness, 0.0), 0.0);
  if (RECEIVER != NDF_NONE) reflection.y = above * distant_specular(r, specular_local(r.lobe, u), inverse_sharpness);
  return reflection;
}

#endif
