// Specular reflection of a spherical-Gaussian light by Laplace's method: the integral of the normalised SG times BRDF times cosine, in 1/sr,
// from the peak of their product and its curvature. GGX, which is no Gaussian, is a mixture of Gaussians; docs/mathematics.md derives it.
#ifndef VSGL_LIB_MIXTURE_LOBE_GLSL
#define VSGL_LIB_MIXTURE_LOBE_GLSL

#include "lib/specular_lobe.glsl"

// The light's spread over projected half vectors h.xy, against the variance of a Gaussian density exp(-|h.xy|^2 / a~^2),
// a~^2 = alpha^2 / (1 - alpha^2): at the mirror direction, in the plane of incidence and across it.
struct MixtureSpread {
  float par, perp;
  float broad;  // 1, or up to 1.5 for lights so broad that a plane stands for the sphere no more
  float plane;  // `par` of a light on a plane, which has no largest spread, down to sharpness 0.03: it turns facets out of sight
};

// Sharpness below 1e-3 counts as that.
MixtureSpread mixture_spread(SpecularReceiver r, float sharpness) {
  float l = max(sharpness, 1e-3);
  float broad = 1.5 + 0.5 * expm1(-l);
  float par = (1.0 - r.alpha2) * broad * phi(-2.0 * l) / r.alpha2;
  float plane = (0.5 - 0.5 * r.alpha2) / (r.alpha2 * max(l, 0.03));
  return MixtureSpread(par, par / r.across_cos2, broad, plane);
}

// How much the axis of a light says about the place of the peak, 0..1: light of sharpness 0 comes from nowhere.
float mixture_direction(uint ndf, float sharpness) {
  return min((ndf == NDF_GGX ? 3.3333333 : 1.0) * max(sharpness, 1e-3), 1.0);
}

// Projected half vector of view and light.
vec2 mixture_half_vector(SpecularReceiver r, vec3 light) {
  vec3 h = vec3(r.sin_view, 0.0, r.cos_view) + light;
  return h.xy * inversesqrt(max(dot(h, h), 1e-6));
}

// GGX as scale mixture: exp(-t X) with weights t e^-t dt is 1 / (1 + X)^2. Scales that are narrow beside the light, t > 1 / x, make up a
// core of mass e^(-1/x) and width tau; those beyond are the tail.
struct MixtureSplit {
  float x;    // 1.6 times the root of the light's spread (the mean of both), 0.01..100
  float tau;  // variance of the core over a~^2 / 2: e^(1/x) E1(1/x), to 0.3% of the spread of core and light
};
MixtureSplit mixture_split(SpecularReceiver r, float sharpness) {
  float spread = (0.5 - 0.5 * r.alpha2) / (r.alpha2 * sqrt(r.across_cos2)) * min(1.0 / max(sharpness, 1e-3), 3.0);
  float x = clamp(1.6 * sqrt(spread), 0.01, 100.0);
  return MixtureSplit(x, x * (1.0 + 0.8596 * x) / (1.0 + x * (1.8105 + 0.3096 * x)));
}

// The core and the light have their product's peak near half vector h: weighed by both spreads and mixture_direction(), exact where either
// is sharp. There the product has the value e^-`exponent` of its factors' peaks, `scale` is the volume under it relative to the density's
// peak, both without the density of normals.
struct MixturePeak {
  vec2 h;          // projected
  float cos2;      // 1 - |h|^2
  float exponent;  // of the light
  float scale;     // includes the cosine that foreshortens facets, over that of the view
};

// From the light's axis to the direction that the view is reflected to about `h`, of height `z`. The axis is such a reflection itself, about
// `half_vector`, so that the difference of both half vectors tells it. Formed anew from `h`, the direction would err by what rounding takes
// from half vectors at grazing views, 6e-8 / (2 cos), which a sharp light multiplies. Opposed to the view, the axis has no half vector.
vec3 mixture_turn(SpecularReceiver r, vec3 light, vec2 half_vector, vec2 h, float z) {
  vec3 view = vec3(r.sin_view, 0.0, r.cos_view), facet = vec3(h, z);
  vec3 sum = view + light;
  float length2 = dot(sum, sum);
  float inverse = inversesqrt(max(length2, 1e-6));
  float height = sum.z * inverse;
  vec3 step = vec3(h - half_vector, z - height);
  step.z = height > 0.0 ? -dot(h + half_vector, step.xy) / (z + height) : step.z;
  return length2 > 1e-6 ? 2.0 * dot(view, step) * facet + length2 * inverse * step : 2.0 * dot(view, facet) * facet - sum;
}

// `half_vector`: of the light's axis. `smith`: part of alpha^2 that widens the mean cosine of visible facets, 1 for GGX as in Smith's
// masking, 1 / pi for Gaussian slopes.
MixturePeak mixture_peak(SpecularReceiver r, MixtureSpread s, vec3 light, float sharpness, vec2 half_vector, float tau, float smith) {
  vec2 share = tau / (tau + vec2(s.par, s.perp));
  vec2 h = mixture_direction(r.ndf, sharpness) * share * half_vector;
  float cos2 = max(1.0 - dot(h, h), 1e-6);
  float z = sqrt(cos2);
  float q = max(r.sin_view * h.x + r.cos_view * z, COS_MIN);  // cosine of half vector and view
  vec3 turn = mixture_turn(r, light, half_vector, h, z);
  float tilt = r.cos_view - q * z;
  float determinant = tau * tau * q * q + tau * s.par * (cos2 + q * q + tilt * tilt) + s.par * s.par * cos2;
  float widening = s.plane / (tau + s.plane) * r.sin_view;
  float seen = 0.5 * (q + sqrt(q * q + smith * r.alpha2 * widening * widening));
  return MixturePeak(h, cos2, 0.5 * max(sharpness, 1e-3) * dot(turn, turn), s.broad * seen * inversesqrt(determinant));
}

// (1 - e^-u (1 + u)) / u^2, the integral of t e^(-u t) for t in 0..1. Relative error 2e-3; what is added to u^2 was fitted.
float mixture_incomplete(float u) {
  float y = min(u, 8.5);
  return 1.0 / (u * u + 1.9965 + y * (1.362 + y * (-0.662 + y * (0.0908 - 0.0041 * y))));
}

// Density of GGX relative to its peak, convolved with the light. `slope2`: squared half vector over a~^2, per axis.
float mixture_tail(MixtureSpread s, float x, vec2 slope2) {
  float rate = 1.9 * x + 0.25;  // 1 / t of the scale by which the light widens the tail
  vec2 sum = rate + vec2(s.par, s.perp);
  float y = 1.0 + rate * dot(slope2 / sum, vec2(1.0));
  return rate * inversesqrt(sum.x) * inversesqrt(sum.y) * mixture_incomplete(y / x) / (x * x);
}

// [EXT] Density of normals at the half vector, filtered by the light, 1/sr.
float mixture_density(SpecularReceiver r, vec3 light, float sharpness) {
  MixtureSpread s = mixture_spread(r, sharpness);
  vec2 h = mixture_half_vector(r, light);
  if (r.ndf != NDF_GGX) {
    MixturePeak peak = mixture_peak(r, s, light, sharpness, h, 1.0, 1.0 / PI);
    return peak.scale * exp(-peak.exponent) * ndf_density(r.ndf, r.alpha2, dot(peak.h, peak.h), peak.cos2);
  }
  float flattening = (1.0 - r.alpha2) / r.alpha2;  // 1 / a~^2
  MixtureSplit split = mixture_split(r, sharpness);
  MixturePeak peak = mixture_peak(r, s, light, sharpness, h, split.tau, 1.0);
  float exponent = peak.exponent + flattening * dot(peak.h, peak.h) / split.tau + 1.0 / split.x;
  h *= mixture_direction(r.ndf, sharpness);
  return (peak.scale * exp(-exponent) + mixture_tail(s, split.x, flattening * h * h)) / (PI * r.alpha2);
}

// [EXT] All densities of normals, any light. Mean error of the peak 0.010 over random surfaces, views and lights; the BRDF times cosine as
// sharpness -> infinity.
float specular_vmf_mixture(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 light = specular_local(r, axis);
  SpecularHorizon horizon = specular_horizon(r, light, sharpness);
  float masking = 1.0 + r.view_lambda + smith_lambda(r.ndf, r.alpha2, horizon.cosine);
  return horizon.visible * mixture_density(r, light, sharpness) / (4.0 * r.cos_view * masking);
}

#endif
