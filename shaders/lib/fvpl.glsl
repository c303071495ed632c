// Filtered virtual point light (FVPL): a cluster of lit texels that emits with its mean BRDF, seen as a Gaussian footprint. With all
// moments of a single texel it is the exact virtual point light. docs/mathematics.md derives it.
// Directions `u` are unit vectors from the receiver to the cluster's mean. Finite for every distance and variance.
#ifndef VSGL_LIB_FVPL_GLSL
#define VSGL_LIB_FVPL_GLSL

#include "interop/cluster.h"
#include "lib/mixture_lobe.glsl"

// A cluster as a receiver sees it.
struct FvplView {
  vec3 u;            // 0 in the very place of the mean
  float d2;          // squared distance, m^2
  float inverse_d2;  // 1/m^2, at most 1e24
  float sharpness;   // d2 / sigma^2: of the normalised SG about u that stands for the footprint
};

// v: from the receiver to the mean, m.
FvplView fvpl_view(vec3 v, float inverse_variance) {
  float d2 = dot(v, v);
  float inverse_d = inversesqrt(max(d2, 1e-24));
  return FvplView(v * inverse_d, d2, inverse_d * inverse_d, min(d2 * inverse_variance, SHARPNESS_MAX));
}

// Whether the cluster lights the receiver like a point. `across`: of the SpecularReceiver, 0 without a specular lobe.
bool fvpl_is_point(float sharpness, float across) {
  return sharpness > CLUSTER_POINT && sharpness > CLUSTER_POINT_SPECULAR * across;
}

// Mean of the clamped cosine of a direction over the cluster's normals, 0..1; c = direction . mean normal.
float fvpl_cosine(float c, float normal_sharpness) {
  return normal_sharpness > CLUSTER_FLAT ? max(c, 0.0) : cosine_mean(c, normal_sharpness);
}

// Density of half vectors, 1/sr, of a GGX lobe whose normals are spread: alpha2 of the surface, `spread` added by the cluster.
// In slopes r it is (alpha2 (r^2 + b) + 2 b (b - alpha2)) / (pi (r^2 + b)^3) with b(alpha2, spread): normalised; to first order in
// the spread it has the peak and the two leading terms of the tail of GGX convolved with a Gaussian, and the Gaussian's peak for a
// large spread. (GGX of alpha^2 + spread would raise the tail by spread / alpha^2, everywhere away from the highlight.)
float ggx_spread_d(float alpha2, float spread, float sin2, float cos2) {
  float b = alpha2 + sqrt(2.0 * spread * (alpha2 + 2.0 * spread));
  float inverse = 1.0 / max(sin2 + b * cos2, min(b, 1.0));
  return (alpha2 + 2.0 * b * (b - alpha2) * cos2 * inverse) * inverse * inverse / PI;
}

// Specular BRDF times the cosine `seen` from the light source to `w`, 1/sr: specular_brdf_cos() with what does not depend on `w`
// hoisted and the lobe widened by the spread of the cluster's half vectors, sigma^2 / (2 d2) of which comes from the directions to the
// receiver; over the constant that c.specular holds. Of normals that spread those reflect that have turned towards the half vector h, and
// these see `w` at a cosine between that of the mean and that of h itself, |h| / 2. The masking is that of the surface itself.
float fvpl_specular(uint ndf, Cluster c, vec3 w, float inverse_d2, float seen) {
  vec3 h = c.incident + w;
  float hn = dot(h, c.shading_normal);
  vec3 t = h - hn * c.shading_normal;
  float hh = max(dot(h, h), 1e-12);
  float inverse = 1.0 / hh;
  float alpha2 = min(c.alpha2 + 0.5 * inverse_d2 / c.inverse_variance, 1.0);
  float sin2 = dot(t, t) * inverse;
  float cos2 = hn * hn * inverse;
  float density = ndf == NDF_GGX  // c.specular holds 1 / pi
                      ? PI * ggx_spread_d(c.masking_alpha2, max(alpha2 - c.masking_alpha2, 0.0), sin2, cos2)
                      : ndf_density(ndf, alpha2, sin2, cos2);
  float cosine = mix(max(dot(w, c.shading_normal), 0.0), 0.5 * sqrt(hh), c.facet_turn);
  float masking = c.incident_masking + smith_lambda(ndf, c.masking_alpha2, cosine);
  return cosine > 0.0 ? density * seen / (max(cosine, COS_MIN) * masking) : 0.0;
}

// Radiant intensity towards the receiver, W/sr, of three classes of clusters.
// Without specular emission, of parallel normals.
vec3 fvpl_emission_diffuse(Cluster c, vec3 u) {
  return max(-dot(u, c.normal), 0.0) * c.diffuse;
}

// Of parallel normals. The surface is seen with its geometric normal; its specular lobe has a horizon of its own.
vec3 fvpl_emission_flat(uint ndf, Cluster c, vec3 u, float inverse_d2) {
  float seen = max(-dot(u, c.normal), 0.0);
  return seen * c.diffuse + fvpl_specular(ndf, c, -u, inverse_d2, seen) * c.specular;
}

// Any.
vec3 fvpl_emission(uint ndf, Cluster c, vec3 u, float inverse_d2) {
  float seen = fvpl_cosine(-dot(u, c.normal), c.normal_sharpness);
  vec3 emission = seen * c.diffuse;
  if (ndf == NDF_NONE) return emission;
  return emission + fvpl_specular(ndf, c, -u, inverse_d2, seen) * c.specular;
}

// What irradiance from the cluster's mean is multiplied by since texels of parallel normals lie in a plane, over which both cosines and
// 1 / d2 vary: exact to first order in 1 / sharpness, 0..2. `cosine`: clamped, at the receiver; `blurred`: 1 if it is a mean over the
// footprint's directions, which is less by 1 / sharpness already, or 0.
float fvpl_plane(Cluster c, vec3 u, vec3 receiver_normal, float cosine, float inverse_sharpness, float blurred) {
  if (c.normal_sharpness <= CLUSTER_FLAT) return 1.0;
  float seen = max(-dot(u, c.normal), 0.0);
  float bend = cosine * (4.0 + blurred - 12.0 * seen * seen) - 4.0 * dot(c.normal, receiver_normal) * seen;
  bend *= min(inverse_sharpness, 0.25);
  return 1.0 + bend / max(cosine + abs(bend), 1e-20);
}

// Radiance per unit of radiant intensity and of each reflectance, 1/m^2: (diffuse, specular). From far away:
vec2 fvpl_point(SpecularReceiver r, Cluster c, FvplView view) {
  float cosine = max(dot(view.u, r.normal), 0.0);
  float diffuse = cosine * fvpl_plane(c, view.u, r.normal, cosine, view.inverse_d2 / c.inverse_variance, 0.0) / PI;
  vec3 eye = vec3(r.sin_view, 0.0, r.cos_view), light = specular_local(r, view.u);
  float specular = r.ndf == NDF_NONE ? 0.0 : specular_brdf_cos(r.ndf, sqrt(r.alpha2), vec3(0.0, 0.0, 1.0), eye, light);
  return view.inverse_d2 * vec2(diffuse, specular);
}

// Irradiance over a sphere per unit of radiant intensity, 1/m^2: 1 / d2 far away, at most 2 / sigma^2.
float fvpl_fluence(float d2, float inverse_variance) {
  float sharpness = d2 * inverse_variance;
  return sharpness > 0.5 ? -expm1(-2.0 * sharpness) / max(d2, 1e-36) : 2.0 * phi(-2.0 * sharpness) * inverse_variance;
}

// From the whole footprint:
vec2 fvpl_extended(SpecularReceiver r, Cluster c, FvplView view) {
  float cosine = cosine_mean(dot(view.u, r.normal), view.sharpness);
  float diffuse = cosine * fvpl_plane(c, view.u, r.normal, cosine, 1.0 / max(view.sharpness, 1.0), 1.0) / PI;
  float specular = r.ndf == NDF_NONE ? 0.0 : specular_vmf_mixture(r, view.u, view.sharpness);
  return fvpl_fluence(view.d2, c.inverse_variance) * vec2(diffuse, specular);
}

#endif
