// Specular reflection of a spherical-Gaussian light: integral of the normalised SG (vMF) times BRDF times cosine, in 1/sr.
// Multiply by the light's fluence and the specular reflectance. All variants stay finite for every sharpness in 0..2^40.
#ifndef VSGL_LIB_SPECULAR_LOBE_GLSL
#define VSGL_LIB_SPECULAR_LOBE_GLSL

#include "lib/frame.glsl"
#include "lib/microfacet.glsl"

// What the integral needs of a surface point, computed once per pixel. Local frame: tangent in the plane of incidence on the side of
// `view`, bitangent across it, normal.
struct SpecularReceiver {
  vec3 tangent, bitangent, normal;
  float sin_view, cos_view;  // cos_view >= 1e-4
  float alpha2;
  float across;       // ndf_sharpness / (4 cos_view^2): sharpness of the lobe across the plane of incidence
  float across_cos2;  // cosine of the view to the normal times that to the dominant normal
  vec2 mirror;        // (tangent, normal) components of the lobe that stands for the BRDF in visibility: axis times sharpness
  float view_lambda;  // Smith's Lambda of the view direction
  uint ndf;
};

// `normal`: shading normal; `view`: towards the eye, unit. A view below the horizon is treated as grazing.
SpecularReceiver specular_receiver(uint ndf, float alpha, vec3 normal, vec3 view) {
  SpecularReceiver r;
  float c = dot(view, normal);
  vec3 t = view - c * normal;
  float t2 = dot(t, t);
  r.tangent = t2 > 1e-12 ? t * inversesqrt(t2) : frame_about(normal)[0];
  r.bitangent = cross(normal, r.tangent);
  r.normal = normal;
  r.sin_view = sqrt(t2);
  r.cos_view = max(c, COS_MIN);
  r.alpha2 = alpha * alpha;
  r.across = ndf_sharpness(ndf, alpha) / (4.0 * r.cos_view * r.cos_view);
  // Reflection at the dominant normal m.
  vec3 v = vec3(r.sin_view, 0.0, r.cos_view);
  vec3 m = dominant_normal(r.alpha2, vec3(0.0, 0.0, 1.0), v);
  r.across_cos2 = r.cos_view * dot(v, m);
  float sharpness = (1.0 - alpha) * (1.0 + alpha) / (2.0 * r.alpha2);
  r.mirror = sharpness * (2.0 * dot(v, m) * m - v).xz;
  r.view_lambda = smith_lambda(ndf, r.alpha2, r.cos_view);
  r.ndf = ndf;
  return r;
}

vec3 specular_local(SpecularReceiver r, vec3 w) {
  return vec3(dot(w, r.tangent), dot(w, r.bitangent), dot(w, r.normal));
}

// Part of the lobe's light that is above the horizon, and the mean cosine of that part.
struct SpecularHorizon {
  float visible;
  float cosine;
};

// [Tokuyoshi 2024] The product of light and BRDF lobes decides how much is above the horizon.
// Deviation: the mean cosine of the visible part, for masking [EXT].
SpecularHorizon specular_horizon(SpecularReceiver r, vec3 light, float sharpness) {
  vec3 p = vec3(r.mirror.x, 0.0, r.mirror.y) + sharpness * light;
  float l2 = max(dot(p, p), 1e-30);
  float inverse = inversesqrt(l2);
  float l = l2 * inverse;
  float c = clamp(p.z * inverse, -1.0, 1.0);
  float visible = vmf_hemisphere(c, l);
  return SpecularHorizon(visible, clamp(cosine_mean(c, l) / max(visible, 1e-30), COS_MIN, 1.0));
}

// GGX density at the half vector after filtering by the light, and the cosine that normalises it.
struct SpecularFilter {
  float density;  // 1/sr
  float slope_cosine;
};

// [Tokuyoshi 2024] NDF filtering: the light's spread, brought to half-vector space, widens the roughness to (m_par, m_perp).
// Deviation: 1 / m_par and 1 / m_perp in a form free of overflow for sharpness 0..2^40 and alpha = 1.
SpecularFilter specular_filter(SpecularReceiver r, vec3 light, float sharpness) {
  float c2 = r.cos_view * r.cos_view;
  float k = max(1.0 - r.alpha2, 1e-20);
  float spread_par = 2.0 * sharpness;
  float spread_perp = spread_par * c2;
  float inverse_par = (spread_par + k) / (spread_par * r.alpha2 + k);
  float inverse_perp = (spread_perp + k) / (spread_perp * r.alpha2 + k);
  vec3 h = vec3(r.sin_view, 0.0, r.cos_view) + light;
  float hh = max(dot(h, h), 1e-8);
  float q = max((h.x * h.x * inverse_par + h.y * h.y * inverse_perp + h.z * h.z) / hh, 1.0);
  return SpecularFilter(sqrt(inverse_par * inverse_perp) / (PI * q * q), sqrt(r.sin_view * r.sin_view / inverse_par + c2));
}

// [Tokuyoshi 2024] as published: filtered GGX over 4 sigma. Without masking it is up to 20 times too bright at the horizon.
float specular_vmf_filtered(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 light = specular_local(r, axis);
  SpecularFilter f = specular_filter(r, light, sharpness);
  return specular_horizon(r, light, sharpness).visible * f.density / (4.0 * f.slope_cosine);
}

// [EXT] GGX: the filtered form with Smith masking, blended into the exact BRDF as the light sharpens (weight w). Median error 7%, mean
// error 6.4% of the peak over the test grid; exact as sharpness -> infinity.
float specular_vmf_ggx(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 light = specular_local(r, axis);
  SpecularFilter f = specular_filter(r, light, sharpness);
  SpecularHorizon horizon = specular_horizon(r, light, sharpness);
  // (1 + L(view)) / (1 + L(view) + L(light)) with s = c (1 + 2 L).
  float z = horizon.cosine;
  float s_view = ggx_slope_cosine(r.alpha2, r.cos_view);
  float masking = z * (r.cos_view + s_view) / (s_view * z + ggx_slope_cosine(r.alpha2, z) * r.cos_view);
  float w = sharpness / (sharpness + 0.3 * r.across);
  float scale = mix(0.25 / f.slope_cosine, 0.5 / (r.cos_view + f.slope_cosine), w);
  return horizon.visible * masking * f.density * scale;
}

// [EXT] Beckmann and Phong: the light widens the Gaussian of projected half vectors. Broad lights (sharpness below 8, wholly below 4)
// fall back to the filtered GGX of equal width. Median error 3.4% (Beckmann), 2.5% (Phong).
float specular_vmf_projected(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 light = specular_local(r, axis);
  SpecularHorizon horizon = specular_horizon(r, light, sharpness);
  float visible_lambda = smith_lambda(r.ndf, r.alpha2, horizon.cosine);
  SpecularFilter f = specular_filter(r, light, sharpness);
  float masking = (1.0 + r.view_lambda) / (1.0 + r.view_lambda + visible_lambda);
  float broad = horizon.visible * masking * f.density / (4.0 * f.slope_cosine);

  float variance = 0.5 / max(sharpness, 1.0);
  float par = r.alpha2 + variance;
  float perp = r.alpha2 + variance / (r.cos_view * r.cos_view);
  vec3 h = vec3(r.sin_view, 0.0, r.cos_view) + light;
  h *= inversesqrt(max(dot(h, h), 1e-8));
  float density = exp(-h.x * h.x / par - h.y * h.y / perp) * inversesqrt(par * perp) / PI;
  float narrow = horizon.visible * density / (4.0 * r.cos_view * (1.0 + r.view_lambda + visible_lambda));
  return mix(broad, narrow, clamp(0.25 * sharpness - 1.0, 0.0, 1.0));
}

// [EXT] The same; sharp lights (across / sharpness below 0.1, wholly below 0.02) take the BRDF at their axis.
float specular_vmf_gaussian(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 view = vec3(r.sin_view, 0.0, r.cos_view);
  float sharp = specular_brdf_cos(r.ndf, sqrt(r.alpha2), vec3(0.0, 0.0, 1.0), view, specular_local(r, axis));
  float w = clamp((0.1 * sharpness - r.across) / (0.08 * max(sharpness, 1e-6)), 0.0, 1.0);
  return mix(specular_vmf_projected(r, axis, sharpness), sharp, w);
}

// The light's spread filters the density of normals, each by the form that its tails ask for, without fall-back for sharp lights.
float specular_vmf_ndf_filter(SpecularReceiver r, vec3 axis, float sharpness) {
  return r.ndf == NDF_GGX ? specular_vmf_filtered(r, axis, sharpness) : specular_vmf_projected(r, axis, sharpness);
}

// GGX by the blended form, Beckmann and Phong by the Gaussian one.
float specular_vmf_blend(SpecularReceiver r, vec3 axis, float sharpness) {
  return r.ndf == NDF_GGX ? specular_vmf_ggx(r, axis, sharpness) : specular_vmf_gaussian(r, axis, sharpness);
}

#endif
