// Microfacet BRDFs without Fresnel: normal distributions, masking, exact values and their lobes.
// alpha: roughness 1e-3..1; a Phong exponent n is held as alpha = sqrt(2 / (n + 2)). Directions are unit vectors pointing away from
// the surface; `view` is the direction whose lobe is taken (towards the eye, or towards the light that a virtual light reflects).
#ifndef VSGL_LIB_MICROFACET_GLSL
#define VSGL_LIB_MICROFACET_GLSL

#include "interop/model.h"
#include "lib/constants.glsl"
#include "lib/sg.glsl"
#include "lib/special.glsl"

// Grazing cosines are floored here: below it no lobe is resolved.
const float COS_MIN = 1e-4;

// [Walter 2007, Eq. (33)] GGX density of normals at an angle of squared sine and cosine sin2, cos2 to the mean normal, 1/sr.
// Deviation: sin2 / alpha^2 + cos2 in place of cos2 (alpha^2 - 1) + 1, which loses all digits at small alpha.
float ggx_d(float alpha2, float sin2, float cos2) {
  float q = max(sin2 + alpha2 * cos2, alpha2);
  return alpha2 / (PI * q * q);
}

// [Walter 2007, Eq. (25)] Beckmann density of normals, 1/sr.
float beckmann_d(float alpha2, float sin2, float cos2) {
  float c2 = max(cos2, 1e-8);
  return exp(-sin2 / (alpha2 * c2)) / (PI * alpha2 * c2 * c2);
}

// [Walter 2007, Eq. (30)] Phong density of normals, (n + 2) / (2 pi) cos^n with n + 2 = 2 / alpha^2, 1/sr. Relative error 1e-5 within
// the lobe.
// Deviation: log(cos^2) from sin2 by the series of atanh, since cos2 has lost the digits that a large exponent needs.
float phong_d(float alpha2, float sin2, float cos2) {
  float z = sin2 / (2.0 - sin2);
  float z2 = z * z;
  float near = -2.0 * z * (1.0 + z2 * (1.0 / 3.0 + z2 * (1.0 / 5.0 + z2 * (1.0 / 7.0 + z2 * (1.0 / 9.0)))));
  float log_cos2 = sin2 < 0.5 ? near : log(max(cos2, 1e-12));
  return exp((1.0 / alpha2 - 1.0) * log_cos2) / (PI * alpha2);
}

float ndf_density(uint ndf, float alpha2, float sin2, float cos2) {
  if (ndf == NDF_GGX) return ggx_d(alpha2, sin2, cos2);
  if (ndf == NDF_BECKMANN) return beckmann_d(alpha2, sin2, cos2);
  return phong_d(alpha2, sin2, cos2);
}

// sqrt(c^2 + alpha^2 (1 - c^2)): GGX's Lambda is (that / c - 1) / 2.
float ggx_slope_cosine(float alpha2, float c) {
  return sqrt(c * c + alpha2 * max(1.0 - c * c, 0.0));
}

// [Heitz 2014, Eq. (72)] Smith's Lambda of GGX.
float ggx_lambda(float alpha2, float c) {
  c = max(c, COS_MIN);
  return 0.5 * (ggx_slope_cosine(alpha2, c) / c - 1.0);
}

// [Heitz 2014] Smith's Lambda of Beckmann. Absolute error 1e-6, relative 1e-4 at grazing angles.
float beckmann_lambda(float alpha2, float c) {
  c = max(c, COS_MIN);
  float a = c * inversesqrt(max(alpha2 * (1.0 - c * c), 1e-12));
  return max(0.5 * exp(-a * a) * (1.0 / (1.7724538509 * a) - erfc_scaled(a)), 0.0);
}

// Phong has no closed Lambda; [Walter 2007] gives it Beckmann's at the alpha of equal width.
float smith_lambda(uint ndf, float alpha2, float c) {
  if (ndf == NDF_GGX) return ggx_lambda(alpha2, c);
  return beckmann_lambda(alpha2, c);
}

// Sharpness of the SG that stands for the density of normals relative to its peak; at least 1e-3.
// [Tokuyoshi 2016, A.1] 2 / alpha^2 for GGX and Beckmann, n for Phong.
// Deviation: 2 / alpha^2 - 2 alpha^2, exact for GGX at alpha 1, where the density is constant; in L1 no worse than 2 / alpha^2 for any
// alpha (0.22 against 0.23 at 0.5, 0 against 0.43 at 1). For Phong n + min((n - 1) / 3, 1), which halves the error from n = 4 on.
float ndf_sharpness(uint ndf, float alpha) {
  float a2 = alpha * alpha;
  float n = 2.0 / a2 - 2.0;
  return max(ndf == NDF_PHONG ? n + clamp((n - 1.0) / 3.0, 0.0, 1.0) : 2.0 / a2 - 2.0 * a2, 1e-3);
}

// BRDF times the cosine of `light`: D G2 / (4 view.normal), height-correlated Smith G2, 1/sr. Zero below the horizon.
// [Walter 2007, Eq. (20)] with [Heitz 2014, Eq. (99)].
float specular_brdf_cos(uint ndf, float alpha, vec3 normal, vec3 view, vec3 light) {
  float alpha2 = alpha * alpha;
  float cos_view = max(dot(view, normal), COS_MIN);
  float cos_light = dot(light, normal);
  vec3 h = view + light;
  float hn = dot(h, normal);
  vec3 t = h - hn * normal;
  float inverse = 1.0 / max(dot(h, h), 1e-12);
  float d = ndf_density(ndf, alpha2, dot(t, t) * inverse, hn * hn * inverse);
  float masking = 1.0 + smith_lambda(ndf, alpha2, cos_view) + smith_lambda(ndf, alpha2, cos_light);
  return cos_light > 0.0 ? d / (4.0 * cos_view * masking) : 0.0;
}

// Normal towards which the lobe of a rough surface leans at grazing angles: the mean of the visible GGX normals points there.
vec3 dominant_normal(float alpha2, vec3 normal, vec3 view) {
  float c = max(dot(view, normal), COS_MIN);
  vec3 tangential = view - dot(view, normal) * normal;
  return normalize(alpha2 * tangential + (c + sqrt(alpha2 * dot(tangential, tangential) + c * c)) * normal);
}

// [Wang 2009; Tokuyoshi 2016, A.1] SG of the reflected lobe: axis = mirror direction, sharpness lambda_h / (4 cos).
SgLobe specular_lobe(uint ndf, float alpha, vec3 normal, vec3 view) {
  float c = dot(view, normal);
  return SgLobe(normalize(2.0 * c * normal - view), ndf_sharpness(ndf, alpha) / (4.0 * max(c, COS_MIN)));
}

#endif
