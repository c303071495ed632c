// lib/mixture_lobe.glsl in faster forms for inner loops: over common denominators and with the faster horizon. Tested against the library's.
#ifndef VSGL_KERNELS_MIXTURE_GLSL
#define VSGL_KERNELS_MIXTURE_GLSL

#include "kernels/fused.glsl"
#include "lib/mixture_lobe.glsl"

// mixture_peak() for tau / f, spreads `par` / f and shares of the half vector, with f free to choose: its scale is `seen` / (2 f root).
// `hidden`: share of the light's spread on a plane.
struct FastPeak {
  vec2 h;
  float cos2, exponent, seen, root;
};
FastPeak fast_mixture_peak(SpecularReceiver r, vec3 light, float sharpness, vec2 half_vector, vec2 share, float hidden, float tau,
                           float par, float smith) {
  vec2 h = half_vector * share;
  float cos2 = max(1.0 - dot(h, h), 1e-6);
  float z = sqrt(cos2);
  float q = max(r.sin_view * h.x + r.cos_view * z, COS_MIN);
  vec3 turn = mixture_turn(r, light, half_vector, h, z);
  float tilt = r.cos_view - q * z;
  float determinant = tau * tau * q * q + par * (tau * (cos2 + q * q + tilt * tilt) + par * cos2);
  float widening = hidden * r.sin_view;
  float seen = q + sqrt(q * q + smith * r.alpha2 * widening * widening);
  return FastPeak(h, cos2, 0.5 * sharpness * dot(turn, turn), seen, sqrt(determinant));
}

// specular_vmf_mixture() of GGX, over common denominators.
float fast_mixture_ggx(SpecularReceiver r, vec3 light, Incoming incoming, vec2 half_vector, vec2 spread, float broad, float slope_view) {
  float flattening = 1.0 / r.alpha2 - 1.0;
  float unit = 1.28 * flattening * inversesqrt(r.across_cos2);  // x^2 times the sharpness
  float x2 = clamp(unit * min(incoming.inverse_sharpness, 3.0), 1e-4, 1e4);
  float inverse_x = sqrt(clamp((1.0 / unit) * max(incoming.sharpness, 1.0 / 3.0), 1e-4, 1e4));
  float x = x2 * inverse_x;
  float tau = x + 0.8596 * x2;  // over tau_below
  float tau_below = 1.0 + 1.8105 * x + 0.3096 * x2;
  vec2 below = tau + spread * tau_below;
  vec2 inverses = below.yx * (1.0 / (below.x * below.y));
  vec2 share = tau * inverses;
  float direction = mixture_direction(NDF_GGX, incoming.sharpness);
  float plane = 0.5 * flattening * min(incoming.inverse_sharpness, 1.0 / 0.03) * tau_below;
  FastPeak peak = fast_mixture_peak(r, light, incoming.sharpness, half_vector, direction * share, plane / (tau + plane), tau,
                                    spread.x * tau_below, 1.0);
  vec2 slope = direction * half_vector;
  vec2 slope2 = flattening * slope * slope;
  float core = 0.5 * broad * peak.seen * tau_below * exp(-peak.exponent - tau_below * dot(slope2 * inverses, share) - inverse_x);

  float rate = 1.9 * x + 0.25;
  vec2 sum = rate + spread;
  float product = sum.x * sum.y;
  float inverse_product = 1.0 / product;
  float u = inverse_x * (1.0 + rate * dot(slope2, sum.yx) * inverse_product);
  float y = min(u, 8.5);
  float tail_below = u * u + 1.9965 + y * (1.362 + y * (-0.662 + y * (0.0908 - 0.0041 * y)));
  float tail = rate * inverse_x * inverse_x * sqrt(product) * inverse_product;

  SpecularHorizon horizon = fast_horizon(r, light, incoming.sharpness);
  float z = horizon.cosine;
  float masking = slope_view * z + ggx_slope_cosine(r.alpha2, z) * r.cos_view;
  float whole = core * tail_below + tail * peak.root;
  return horizon.visible * z * whole / (2.0 * PI * r.alpha2 * masking * tail_below * peak.root);
}

// specular_vmf_mixture() of Beckmann and Phong.
float fast_mixture_gaussian(SpecularReceiver r, vec3 light, Incoming incoming, vec2 half_vector, vec2 spread, float broad) {
  vec2 below = 1.0 + spread;
  vec2 share = mixture_direction(r.ndf, incoming.sharpness) * below.yx * (1.0 / (below.x * below.y));
  float plane = (0.5 / r.alpha2 - 0.5) * min(incoming.inverse_sharpness, 1.0 / 0.03);
  FastPeak peak =
      fast_mixture_peak(r, light, incoming.sharpness, half_vector, share, plane / (1.0 + plane), 1.0, spread.x, 1.0 / PI);
  float density = exp(-peak.exponent) * ndf_density(r.ndf, r.alpha2, dot(peak.h, peak.h), peak.cos2);
  SpecularHorizon horizon = fast_horizon(r, light, incoming.sharpness);
  float masking = 1.0 + r.view_lambda + smith_lambda(r.ndf, r.alpha2, horizon.cosine);
  return horizon.visible * broad * peak.seen * density / (8.0 * r.cos_view * masking * peak.root);
}

// specular_vmf_mixture(). `light`: local; `slope_view`: ggx_slope_cosine of the view.
float fast_specular_mixture(SpecularReceiver r, vec3 light, Incoming incoming, float slope_view) {
  float broad = 1.0 + 0.5 * incoming.decay;
  float par = (0.5 / r.alpha2 - 0.5) * broad * incoming.phi * (1.0 + incoming.decay);
  vec2 spread = par * vec2(1.0, 1.0 / r.across_cos2);
  vec2 half_vector = mixture_half_vector(r, light);
  if (r.ndf == NDF_GGX) return fast_mixture_ggx(r, light, incoming, half_vector, spread, broad, slope_view);
  return fast_mixture_gaussian(r, light, incoming, half_vector, spread, broad);
}

#endif
