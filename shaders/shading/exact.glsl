// Exact reflection, without any spherical Gaussian.
#ifndef VSGL_SHADING_EXACT_GLSL
#define VSGL_SHADING_EXACT_GLSL

#include "shading/receiver.glsl"

// BRDF times the cosine `numerator` at half vector h, of squared tangential and normal components `sin2` and `cos2` (not normalised):
// specular_brdf_cos() of lib/microfacet.glsl with what depends on the view alone hoisted: `slope_view` = ggx_slope_cosine,
// `view_lambda` = smith_lambda. `numerator` is the cosine of the light, or of its geometric counterpart.
float exact_specular(uint ndf, float alpha2, float cos_view, float slope_view, float view_lambda, float cos_light, float numerator,
                     float sin2, float cos2) {
  float c = max(cos_light, 0.0);
  float hh = max(sin2 + cos2, 1e-8);
  if (ndf == NDF_GGX) {
    float q = max(sin2 + alpha2 * cos2, alpha2 * hh);
    float below = 2.0 * PI * q * q * (slope_view * c + ggx_slope_cosine(alpha2, c) * cos_view);
    return c > 0.0 ? alpha2 * hh * hh * numerator / below : 0.0;
  }
  float masking = 1.0 + view_lambda + smith_lambda(ndf, alpha2, c);
  float density = ndf_density(ndf, alpha2, sin2 / hh, cos2 / hh);
  return c > 0.0 ? density * numerator / (4.0 * cos_view * max(c, COS_MIN) * masking) : 0.0;
}

// Radiance per unit of irradiance on a plane facing `u`, for each unit reflectance, 1/sr: nothing below the geometric horizon.
vec2 exact_reflection(Receiver r, vec3 u) {
  float above = BUMPED == 0 || dot(r.geometric, u) > 0.0 ? 1.0 : 0.0;
  vec2 reflection = vec2(above * max(dot(r.normal, u), 0.0) * INVERSE_PI, 0.0);
  if (RECEIVER == NDF_NONE) return reflection;
  vec3 light = specular_local(r.lobe, u);
  vec3 h = vec3(r.lobe.sin_view, 0.0, r.lobe.cos_view) + light;
  reflection.y = above * exact_specular(r.lobe.ndf, r.lobe.alpha2, r.lobe.cos_view, r.slope_view, r.lobe.view_lambda, light.z,
                                        light.z, h.x * h.x + h.y * h.y, h.z * h.z);
  return reflection;
}

#endif
