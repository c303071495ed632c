// Spherical Gaussians G(w; axis, sharpness) = exp(sharpness (w.axis - 1)). Axes are unit vectors, sharpness is 0..2^40.
#ifndef VSGL_LIB_SG_GLSL
#define VSGL_LIB_SG_GLSL

#include "lib/constants.glsl"
#include "lib/special.glsl"

struct SgLobe {
  vec3 axis;
  float sharpness;
};

// Product of two SGs: e^exponent times the SG of `axis` and `sharpness`.
struct SgProduct {
  vec3 axis;
  float sharpness;
  float exponent;  // <= 0
};

// [Wang 2009] as exp(-(sharpness / 2) |w - axis|^2).
// Deviation: sharpness (w.axis - 1) has an absolute error of 15 in float32 at sharpness 1e8; this form's is below 1e-6.
float sg_value(vec3 w, vec3 axis, float sharpness) {
  vec3 d = w - axis;
  return exp(-0.5 * sharpness * dot(d, d));
}

// Integral over the sphere, (2 pi / sharpness)(1 - e^(-2 sharpness)), in sr. Relative error 3e-7, 4 pi at sharpness 0.
float sg_integral(float sharpness) {
  return 4.0 * PI * phi(-2.0 * sharpness);
}

// [Wang 2009] exact product. Exponent: absolute error below 5e-6 for any pair of sharpnesses up to 1e12.
// Deviation: the exponent l_m - l1 - l2 is multiplied by its conjugate, and opposing axes take the sum of squares, so that
// nothing cancels. Equal and opposite lobes have no axis; axis1 stands in.
SgProduct sg_product(vec3 axis1, float sharpness1, vec3 axis2, float sharpness2) {
  vec3 m = sharpness1 * axis1 + sharpness2 * axis2;
  vec3 sum = axis1 + axis2;
  vec3 difference = axis1 - axis2;
  float gap = sharpness1 - sharpness2;
  float opposed = gap * gap + sharpness1 * sharpness2 * dot(sum, sum);
  float aligned = dot(m, m);
  float sharpness = sqrt(dot(axis1, axis2) < 0.0 ? opposed : aligned);
  float total = max(sharpness + sharpness1 + sharpness2, 1e-36);
  vec3 axis = aligned > 1e-36 ? m * inversesqrt(aligned) : axis1;
  return SgProduct(axis, sharpness, -sharpness1 * (sharpness2 / total) * dot(difference, difference));
}

// [Tokuyoshi 2022] Mass of the normalised SG above the plane through the origin, c = axis.normal: 0..1. Error 0.0047 of the peak.
// The floor of s stands for the limit (1 + c) / 2 and costs 3e-5.
float vmf_hemisphere(float c, float sharpness) {
  float l = sharpness;
  float s = max(l * sqrt((0.5 * l + 0.6517328827) / ((l + 1.3418280033) * l + 7.2216687798)), 1e-2);
  float t = clamp(0.5 + 0.5 * (1.0 - erfc(s * c)) / (1.0 - erfc(s)), 0.0, 1.0);
  float e = 1.0 + expm1(-l);
  return (e + (1.0 - e) * t) / (1.0 + e);
}

// [Tokuyoshi 2024] Mean of the clamped cosine max(w.n, 0) under the normalised SG, c = axis.n: 0..1.
// Error 1.3e-3 of the peak (at sharpness 4; below 1.5e-4 from 32 on), the same in float32 for sharpness 0..2^40.
// Deviation: a Taylor series below sharpness 0.05 and a form of `t` that does not overflow.
float cosine_mean(float c, float sharpness) {
  float l = sharpness;
  c = clamp(c, -1.0, 1.0);  // the product of two unit vectors may be more, and l makes much of it
  float m = max(l, 0.05);
  float em1 = expm1(-m);
  float e = 1.0 + em1;
  float p = -em1 / m;  // phi(-l); up and low are the integrals for c = 1 and c = -1 over 2 pi
  bool series = l < 0.05;
  float up = series ? 0.5 + l * (-1.0 / 6.0 + l * (1.0 / 24.0 + l * (-1.0 / 120.0))) : (1.0 - p) / m;
  float low = series ? 0.5 + l * (-5.0 / 6.0 + l * (17.0 / 24.0 - l * (49.0 / 120.0))) : e * (p - e) / m;
  float whole = series ? 2.0 + l * (-2.0 + l * (4.0 / 3.0 - l * (2.0 / 3.0))) : p * (1.0 + e);
  // t = l sqrt(N(l) / (2 D(l))) with both polynomials divided by their leading power where l > 1.
  float i = 1.0 / max(l, 1.0);
  float s = min(l, 1.0);
  float numerator = s * s + i * (2.7360831611 * s + 17.0212977817 * i);
  float denominator = s * s * s + i * (4.0100826729 * s * s + i * (15.2191562631 * s + 76.0878962724 * i));
  float t = max(sqrt(l * s * numerator / (2.0 * denominator)), 1e-18);
  float x = t * abs(c);
  float peak = exp(-x * x);
  float rest = expm1(-t * t * (1.0 - c) * (1.0 + c));
  float erfc_c = erfc_scaled(x) * peak;
  erfc_c = c > 0.0 ? 2.0 - erfc_c : erfc_c;
  float erfc_1 = erfc_scaled(t) * peak * (1.0 + rest);
  float f = clamp(0.5 * (c * erfc_c + erfc_1) - peak * rest / (3.5449077018 * t), 0.0, 1.0);
  return (low + (up - low) * f) / whole;
}

// Integral of the SG times max(w.n, 0) over the sphere.
float cosine_integral(float c, float sharpness) {
  return sg_integral(sharpness) * cosine_mean(c, sharpness);
}

#endif
