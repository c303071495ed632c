#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "shading/receive.glsl"
#include "test/stability/published.glsl"

// What the shading kernels compute, and forms beside it (tests/stability). RECEIVER must be NDF_ANY.

// At the origin, its normal +z, seen from `view`.
Receiver take_receiver() {
  Surface s;
  s.position = vec3(0.0);
  s.normal = s.shading_normal = vec3(0.0, 0.0, 1.0);
  s.ndf = take_uint();
  s.alpha = take();
  s.id = 0u;
  s.diffuse = s.specular = vec3(1.0);
  s.depth = 1.0;
  return make_receiver(0u, s, take3());
}

// Offset of the light, its variance, emission axis and sharpness.
Incoming take_light() {
  vec3 v = take3();
  float variance = take();
  vec3 axis = take3();
  float d2 = dot(v, v);
  return incoming_light(d2 > 1e-36 ? v * inversesqrt(d2) : -axis, d2, variance, 1.0 / variance, axis, take());
}

// Light of `sharpness` about `axis`.
Incoming lobe_light(vec3 axis, float sharpness) { return incoming_light(axis, sharpness, 1.0, 1.0, -axis, 0.0); }
float fluence(Incoming light) { return light.amplitude * light.phi * (1.0 + light.decay); }

// [Tokuyoshi 2016, C.2] The anisotropic lobe with coefficient and smooth term at the light's axis.
float published_asg(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 light = specular_local(r, axis), in_lobe = reflected_local(r, light);
  return specular_coefficient(r, light.z) * max(in_lobe.z, 0.0) * specular_asg_convolved(r, in_lobe, sharpness);
}

// [Wang 2009] Two SGs with the exponent as a difference and the integral of both factors formed.
float published_sg_product(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 mirror = vec3(-r.sin_view, 0.0, r.cos_view), light = specular_local(r, axis);
  float lobe = r.across * r.cos_view;
  vec2 product = published_product(mirror, lobe, light, sharpness);
  float cosine = normalize(lobe * mirror + sharpness * light).z;
  return specular_coefficient(r, cosine) * exp(product.y) * published_sg_integral(product.x) / published_sg_integral(sharpness);
}

// [Tokuyoshi 2014s] Two anisotropic SGs by the eigenvalues of the sum of their forms. The axis is the library's.
float published_asg_asg(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 light = reflected_local(r, specular_local(r, axis));
  vec2 eta = reflected_bandwidths(r);
  AsgProduct product = asg_product(light, eta, 0.5 * sharpness);
  float cosine = r.sin_view * product.axis.y + r.cos_view * product.axis.z;
  float exponent = published_asg_exponent(light, eta, 0.5 * sharpness);
  return specular_coefficient(r, cosine) * exp(-exponent) * product.integral / published_sg_integral(sharpness);
}

// [Tokuyoshi 2024] as printed, for every density of normals.
float published_ndf_filter(SpecularReceiver r, vec3 axis, float sharpness) {
  vec3 light = specular_local(r, axis);
  SpecularFilter f = published_filter(r, light, sharpness);
  return specular_horizon(r, light, sharpness).visible * f.density / (4.0 * f.slope_cosine);
}

// [Tokuyoshi 2016, Eq. (7)] A normalised SG of the lobe's sharpness: its product with the light, and no coefficient.
float published_normalised(SpecularReceiver r, vec3 axis, float sharpness) {
  float lobe = r.across * r.cos_view;
  SgProduct product = sg_product(vec3(-r.sin_view, 0.0, r.cos_view), lobe, specular_local(r, axis), sharpness);
  return exp(product.exponent) * (sg_integral(product.sharpness) / (sg_integral(lobe) * sg_integral(sharpness)));
}

void put_incoming() {
  Incoming light = take_light();
  put(light.axis);
  put(light.sharpness);
  put(fluence(light));
}

// incoming_light() with the squares of d2 and variance times sharpness.
void put_unscaled_incoming() {
  vec3 v = take3();
  float variance = take();
  vec3 axis = take3();
  float sharpness = take();
  float d2 = dot(v, v), b = variance * sharpness;
  vec3 u = v * inversesqrt(d2), m = d2 * u - b * axis, turn = u + axis;
  float q = sqrt(dot(m, m)) + 1e-18, total = q + b + d2, inverse = 1.0 / (q * total);
  put(m * (total * inverse));
  put(clamp(q / variance, SHARPNESS_MIN, SHARPNESS_MAX));
  put(exp(-sharpness * d2 * (q * inverse) * dot(turn, turn)) * (total * inverse));
}

void put_library_fluence() {
  VsglIncoming light = vsgl_incoming(take3(), take(), take3(), take());
  put(light.fluence);
}

void put_cosine() {
  float c = take(), sharpness = take();
  Incoming light = lobe_light(vec3(sqrt(max(1.0 - c * c, 0.0)), 0.0, c), sharpness);
  put(received_cosine(light, c) / fluence(light));
}

void call() {
  switch (FUNCTION) {
    case 0u: put_incoming(); return;
    case 1u: put_cosine(); return;
    case 2u: {
      Receiver r = take_receiver();
      put(receive(r, take_light()));
      return;
    }
    case 9u: put_library_fluence(); return;
    case 10u: put(published_cosine_mean(take(), take())); return;
    case 11u: put(published_cosine_difference(take(), take())); return;
    case 12u: put(pulled_out_cosine(take())); return;
    case 13u: put(sg_cosine_mean(take(), take())); return;
    case 14u: put(vmf_hemisphere(take(), take())); return;
    case 15u: put(cosine_mean(take(), take())); return;
    case 16u: put(published_fluence(take3(), take(), take3(), take())); return;
    case 17u: put_unscaled_incoming(); return;
  }
  // All of them get the light's axis as the kernels have it: rounded once more.
  Receiver r = take_receiver();
  vec3 axis = take3();
  Incoming light = lobe_light(axis, take());
  switch (FUNCTION) {
    case 3u: put(specular_answer(r, light)); break;
    case 4u: put(published_sg_product(r.lobe, light.axis, light.sharpness)); break;
    case 5u: put(published_asg(r.lobe, light.axis, light.sharpness)); break;
    case 6u: put(published_asg_asg(r.lobe, light.axis, light.sharpness)); break;
    case 7u: put(published_ndf_filter(r.lobe, light.axis, light.sharpness)); break;
    case 8u: put(published_normalised(r.lobe, light.axis, light.sharpness)); break;
  }
}
