// Exact reflection at both ends of a light path: what a virtual point light carries.
#ifndef VSGL_SHADING_EMISSION_GLSL
#define VSGL_SHADING_EMISSION_GLSL

#include "shading/common.glsl"
#include "shading/exact.glsl"

// Intensity that leaves the representative surface point along `w`, per watt of each lobe, 1/sr: Lambert, and the specular BRDF in the
// frame of the shading normal; the surface is seen with its geometric normal.
vec2 exact_emission(ShadingLight light, vec3 w) {
  float seen = max(dot(light.normal, w), 0.0);
  vec2 emission = vec2(seen * INVERSE_PI, 0.0);
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

// Both at once; `density`: 1 / d^2 or what bounds it, 1/m^2; `u`: towards the light.
Transfer exact_transfer(Receiver r, ShadingLight light, vec3 u, float density) {
  vec2 emission = density * exact_emission(light, -u);
  vec2 reflection = exact_reflection(r, u);
  return Transfer(reflection.x * emission, reflection.y * emission);
}

#endif
