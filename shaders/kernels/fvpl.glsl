// lib/fvpl.glsl in faster forms for inner loops: over common denominators, and with the polynomials of kernels/fused.glsl. What depends on
// the cluster alone is invariant in a loop over pixels. Each is tested against the library's form.
#ifndef VSGL_KERNELS_FVPL_GLSL
#define VSGL_KERNELS_FVPL_GLSL

#include "kernels/fused.glsl"
#include "lib/fvpl.glsl"

// fvpl_cosine().
float fast_fvpl_cosine(float c, float normal_sharpness) {
  float l = clamp(normal_sharpness, SHARPNESS_MIN, CLUSTER_FLAT);
  float inverse = 1.0 / l;
  float decayed = fast_expm1(-l);
  float decay = 1.0 + decayed;
  float phi = -decayed * inverse;
  float spread = cosine_integral_2pi(c, decay, phi, inverse, ramp_width(l, inverse)) / (phi * (1.0 + decay));
  return normal_sharpness > CLUSTER_FLAT ? max(c, 0.0) : spread;
}

// fvpl_specular(), w = -u. For GGX with 1 + Lambda = (c + s) / (2 c), s = ggx_slope_cosine: one division.
float fast_fvpl_specular(uint ndf, Cluster c, vec3 u, float inverse_d2, float seen) {
  if (ndf != NDF_GGX) return fvpl_specular(ndf, c, -u, inverse_d2, seen);
  vec3 h = c.incident - u;
  float hh = max(dot(h, h), 1e-8);
  float hn = dot(h, c.shading_normal);
  vec3 t = h - hn * c.shading_normal;
  float alpha2 = c.masking_alpha2;
  float spread = max(min(c.alpha2 + (0.5 / c.inverse_variance) * inverse_d2, 1.0) - alpha2, 0.0);
  float b = alpha2 + sqrt(2.0 * spread * (alpha2 + 2.0 * spread));
  float q = max(dot(t, t) + b * hn * hn, min(b, 1.0) * hh);
  float z = mix(max(-dot(u, c.shading_normal), 0.0), 0.5 * sqrt(hh), c.facet_turn);
  float masking = (2.0 * c.incident_masking - 1.0) * z + ggx_slope_cosine(alpha2, z);
  float inverse = 1.0 / (q * masking);
  float inverse_q = inverse * masking;
  float sharp = hh * inverse_q;
  float density = sharp * sharp * (alpha2 + 2.0 * b * (b - alpha2) * hn * hn * inverse_q);
  return z > 0.0 ? 2.0 * seen * density * (inverse * q) : 0.0;
}

// fvpl_emission_flat().
vec3 fast_fvpl_emission_flat(uint ndf, Cluster c, vec3 u, float inverse_d2) {
  float seen = max(-dot(u, c.normal), 0.0);
  return seen * c.diffuse + fast_fvpl_specular(ndf, c, u, inverse_d2, seen) * c.specular;
}

// fvpl_emission().
vec3 fast_fvpl_emission(uint ndf, Cluster c, vec3 u, float inverse_d2) {
  float seen = fast_fvpl_cosine(-dot(u, c.normal), c.normal_sharpness);
  vec3 emission = seen * c.diffuse;
  if (ndf == NDF_NONE) return emission;
  return emission + fast_fvpl_specular(ndf, c, u, inverse_d2, seen) * c.specular;
}

// The footprint as light that arrives: fluence fvpl_fluence() = amplitude phi (1 + decay).
Incoming fvpl_incoming(FvplView view, float inverse_variance) {
  Incoming light;
  light.axis = view.u;
  light.sharpness = max(view.sharpness, SHARPNESS_MIN);
  light.inverse_sharpness = min(view.inverse_d2 * (1.0 / inverse_variance), 1.0 / SHARPNESS_MIN);
  light.amplitude = inverse_variance;
  float decayed = fast_expm1(-light.sharpness);
  light.decay = 1.0 + decayed;
  light.phi = -decayed * light.inverse_sharpness;
  return light;
}

#endif
