// Specular reflection with the BRDF times cosine as one lobe about the mirror direction: a coefficient times an SG or an ASG, whose product
// with the light's lobe has a closed integral. Each specular_vmf_* is the integral of the normalised SG times BRDF times cosine, 1/sr.
// Deviation: the papers take the coefficient at the light's axis. Here it is taken at the axis of the product of both lobes, which is no
// less accurate anywhere and keeps the light of broad lobes, whose axis says little.
#ifndef VSGL_LIB_REFLECTED_LOBE_GLSL
#define VSGL_LIB_REFLECTED_LOBE_GLSL

#include "lib/specular_lobe.glsl"

// BRDF times cosine over the density of normals relative to its peak, in a direction at `cosine` to the normal.
float specular_coefficient(SpecularReceiver r, float cosine) {
  float masking = 1.0 + r.view_lambda + smith_lambda(r.ndf, r.alpha2, cosine);
  return cosine > 0.0 ? 1.0 / (4.0 * PI * r.alpha2 * r.cos_view * masking) : 0.0;
}

// The lobe's frame, from the receiver's local one: x across the plane of incidence, y within it, z = mirror direction.
vec3 reflected_local(SpecularReceiver r, vec3 light) {
  return vec3(light.y, r.cos_view * light.x + r.sin_view * light.z, r.cos_view * light.z - r.sin_view * light.x);
}

// Bandwidths of the lobe's ASG along its x and y: lambda_h / (8 cos^2) and lambda_h / 8, with lambda_h = 2 / alpha^2
// [Tokuyoshi 2016, A.1]: never small, as the forms below need.
vec2 reflected_bandwidths(SpecularReceiver r) {
  float eta = 0.25 / r.alpha2;
  return vec2(eta / (r.cos_view * r.cos_view), eta);
}

// [Wang 2009] Both as SGs, the reflected lobe's sharpness lambda_h / (4 cos). Too round at grazing angles.
float specular_vmf_sg(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 mirror = vec3(-r.sin_view, 0.0, r.cos_view);
  SgProduct product = sg_product(mirror, r.across * r.cos_view, specular_local(r, axis), sharpness);
  return specular_coefficient(r, product.axis.z) * exp(product.exponent) * (sg_integral(product.sharpness) / sg_integral(sharpness));
}

// [Xu 2013] integral of the normalised SG times the lobe's ASG without its smooth term; `light` in the lobe's frame.
float specular_asg_convolved(SpecularReceiver r, vec3 light, float sharpness) {
  float nu = 0.5 * sharpness;
  vec2 eta = reflected_bandwidths(r);
  float exponent = dot(eta * (nu / (eta + nu)), light.xy * light.xy);
  return PI * exp(-exponent) * inversesqrt((eta.x + nu) * (eta.y + nu)) / sg_integral(sharpness);
}

// [Tokuyoshi 2016, C.2] ASG for the reflected lobe, SG for the light.
// Deviation: below sharpness 8 (wholly below 4) the smooth term at the axis of the product, too.
float specular_vmf_asg(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 light = specular_local(r, axis);
  vec3 mirror = vec3(-r.sin_view, 0.0, r.cos_view);
  float lobe = 0.5 / (r.alpha2 * r.cos_view);  // 2 sqrt(eta.x eta.y)
  vec3 product = lobe * mirror + sharpness * light;
  product *= inversesqrt(max(dot(product, product), 1e-30));
  vec3 smooth_axis = mix(product, light, clamp(0.25 * sharpness - 1.0, 0.0, 1.0));
  float smooth_term = max(dot(smooth_axis, mirror), 0.0);
  return specular_coefficient(r, product.z) * smooth_term * specular_asg_convolved(r, reflected_local(r, light), sharpness);
}

struct AsgProduct {
  vec3 axis;       // unit, in the first lobe's frame
  float exponent;  // >= 0
  float integral;  // sr, smooth terms at the axis included; times e^-exponent that of the product
};

// [Xu 2013] Product of the ASGs of bandwidths eta about z and (nu, nu) about `light`, unit, in the first one's frame. The exponents add up
// to the quadratic form diag(eta, 0) + nu (I - light light^T); its least eigenvalue nu m is the exponent, its eigenvector the axis.
// Deviation: m by Newton's method on the secular equation m = sum_i light_i^2 eta_i / (eta_i + nu (1 - m)), from 0. Nothing cancels, where
// a solver of eigenvalues loses all digits of the least one beside large bandwidths. Error of the exponent 2e-5 for lobes up to
// 78 degrees apart, where five steps are more than enough, 0.08 beyond.
AsgProduct asg_product(vec3 light, vec2 eta, float nu) {
  vec2 squared = light.xy * light.xy;
  float m = 0.0;
  for (int i = 0; i < 5; ++i) {
    vec2 inverse = 1.0 / (eta + nu * (1.0 - m));
    vec2 terms = squared * eta * inverse;
    float slope = 1.0 - nu * dot(terms, inverse);
    m = min(m + (terms.x + terms.y - m) / max(slope, 1e-3), squared.x + squared.y);
  }
  float p = max(1.0 - m, 1e-12);
  vec2 sum = eta + nu * p;
  vec3 w = vec3(light.xy * (nu * p / sum), light.z);
  float inverse_length = inversesqrt(max(dot(w, w), 1e-24));
  float smooth_terms = max(light.z, 0.0) * p * inverse_length * inverse_length;
  return AsgProduct(w * inverse_length, nu * m, PI * smooth_terms * inverse_length * sqrt(p / sum.x) * inversesqrt(sum.y));
}

// [Tokuyoshi 2014s] Both as ASGs, the light's of bandwidths sharpness / 2.
float specular_vmf_asg_asg(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 light = reflected_local(r, specular_local(r, axis));
  AsgProduct product = asg_product(light, reflected_bandwidths(r), 0.5 * sharpness);
  float cosine = r.sin_view * product.axis.y + r.cos_view * product.axis.z;
  return specular_coefficient(r, cosine) * exp(-product.exponent) * product.integral / sg_integral(sharpness);
}

#endif
