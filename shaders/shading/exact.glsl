// Exact reflection at both ends of a light path: what a virtual point light carries.
#ifndef VSGL_SHADING_EXACT_GLSL
#define VSGL_SHADING_EXACT_GLSL

#include "shading/common.glsl"

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

// Intensity that leaves the representative surface point along `w`, per watt of each lobe, 1/sr: Lambert, and the specular BRDF in the
// frame of the shading normal; the surface is seen with its geometric normal.
vec2 exact_emission(ShadingLight light, vec3 w) {
  float seen = max(dot(light.normal, w), 0.0);
  vec2 emission = vec2(seen / PI, 0.0);
  if (EMISSION == NDF_NONE) return emission;
  uint ndf = EMISSION == NDF_ANY ? light.ndf : EMISSION;
  float alpha2 = light.alpha * light.alpha;
  vec3 n = light.shading_normal;
  vec3 h = light.incident + w;
  float hn = dot(h, n);
  vec3 t = h - hn * n;
  float slope = ggx_slope_cosine(alpha2, light.cos_incident);
  float lambda = smith_lambda(ndf, alpha2, light.cos_incident);
  emission.y =
      exact_specular(ndf, alpha2, light.cos_incident, slope, lambda, dot(n, w), seen, dot(t, t), hn * hn);
  return emission;
}

// Radiance per unit of irradiance on a plane facing `u`, for each unit reflectance, 1/sr: nothing below the geometric horizon.
vec2 exact_reflection(Receiver r, vec3 u) {
  float above = BUMPED == 0 || dot(r.geometric, u) > 0.0 ? 1.0 : 0.0;
  vec2 reflection = vec2(above * max(dot(r.normal, u), 0.0) / PI, 0.0);
  if (RECEIVER == NDF_NONE) return reflection;
  vec3 light = specular_local(r.lobe, u);
  vec3 h = vec3(r.lobe.sin_view, 0.0, r.lobe.cos_view) + light;
  reflection.y = above * exact_specular(r.lobe.ndf, r.lobe.alpha2, r.lobe.cos_view, r.slope_view, r.lobe.view_lambda, light.z,
                                        light.z, h.x * h.x + h.y * h.y, h.z * h.z);
  return reflection;
}

// Both at once; `density`: 1 / d^2 or what bounds it, 1/m^2; `u`: towards the light.
Transfer exact_transfer(Receiver r, ShadingLight light, vec3 u, float density) {
  vec2 emission = density * exact_emission(light, -u);
  vec2 reflection = exact_reflection(r, u);
  return Transfer(reflection.x * emission, reflection.y * emission);
}

#endif
