// Faster forms of shader-library functions for the inner loop: without exponentials and divisions where a polynomial does, and with
// intermediate results shared. Each is tested against the library's form.
#ifndef VSGL_KERNELS_FUSED_GLSL
#define VSGL_KERNELS_FUSED_GLSL

#include "lib/specular_lobe.glsl"
#include "lib/vsgl.glsl"

// Sharpness of incoming light is floored here, where an SG is constant to 0.1%: low and up below then need no series.
const float SHARPNESS_MIN = 1e-3;

// erfc(x) for x >= 0. Absolute error 8e-6; fitted with the exact slope at 0 (Lawson's minimax iteration on p, erfc = p^8).
float fast_erfc(float x) {
  float y = min(x, 4.0);
  float p = 1.0 + y * (-0.141047396 + y * (-0.0695034639 + y * (-0.00282007664 + y * (0.00803070935 - y * 0.00107486658))));
  float p2 = p * p;
  float p4 = p2 * p2;
  return p4 * p4;
}

// e^(-x^2) / (2 sqrt(pi)) - x erfc(x) / 2 for x >= 0, the rounding of a Gaussian ramp at its foot. Absolute error 1e-6; fitted likewise.
float ramp_foot(float x) {
  float y = min(x, 4.0);
  float p = 0.853688407 + y * (-0.189140413 + y * (-0.0398918388 + y * (0.00261670626 + y * (0.00437063948 - y * 0.000656774906))));
  float p2 = p * p;
  float p4 = p2 * p2;
  return p4 * p4;
}

// e^x - 1 for x <= 0. Relative error 2e-5.
float fast_expm1(float x) {
  float series = x * (1.0 + x * (0.5 + x * (0.166666667 + x * (0.0416666667 + x * 0.00833333333))));
  return x > -0.25 ? series : exp(x) - 1.0;
}

// Light that a pixel receives from one emission lobe.
struct Incoming {
  vec3 axis;
  float sharpness, inverse_sharpness;
  float amplitude;      // 1/m^2
  float decay, phi;     // e^-sharpness and (1 - e^-sharpness) / sharpness
};

// vsgl_product() of lib/vsgl.glsl: fluence = amplitude phi (1 + decay). Variance times sharpness comes to 1e21 m^2, whose square float32
// does not hold: there areas are counted in 1e15 m^2.
Incoming incoming_light(vec3 u, float d2, float variance, float inverse_variance, vec3 emission_axis, float emission_sharpness) {
  bool huge = d2 + variance * emission_sharpness > 1e15;
  float unit = huge ? 1e-15 : 1.0;
  d2 *= unit;
  variance *= unit;
  float b = variance * emission_sharpness;
  vec3 m = d2 * u - b * emission_axis;
  float q = sqrt(dot(m, m)) + 1e-18;
  float total = q + b + d2;
  float inverse = 1.0 / (q * total);
  vec3 turn = u + emission_axis;
  float exponent = -emission_sharpness * d2 * (q * inverse) * dot(turn, turn);
  Incoming light;
  light.axis = m * (total * inverse);
  light.sharpness = clamp(q * (huge ? 1e15 : 1.0) * inverse_variance, SHARPNESS_MIN, SHARPNESS_MAX);
  light.inverse_sharpness = min(variance * (total * inverse), 1.0 / SHARPNESS_MIN);
  light.amplitude = exp(exponent) * inverse_variance;
  float decayed = fast_expm1(-light.sharpness);
  light.decay = 1.0 + decayed;
  light.phi = -decayed * light.inverse_sharpness;
  return light;
}

// The width t(sharpness) of the clamped cosine's Gaussian ramp, and 1 / t [Tokuyoshi 2024], as in cosine_mean(). From 1e5 on
// t^2 / sharpness is constant to 1e-5.
vec2 ramp_width(float sharpness, float inverse_sharpness) {
  float l = min(sharpness, 1e5);
  float numerator = l * ((l + 2.7360831611) * l + 17.0212977817);
  float denominator = ((2.0 * l + 8.0201653458) * l + 30.4383125262) * l + 152.1757925448;
  float inverse = 1.0 / (numerator * denominator);
  float t = sqrt(sharpness * numerator * (numerator * inverse));
  return vec2(t, t * denominator * (denominator * inverse) * inverse_sharpness);
}

// Integral of the SG times max(w.n, 0) over 2 pi, c = axis.n: cosine_integral() of lib/sg.glsl.
// With f of [Tokuyoshi 2024] rewritten as max(c, 0) + (foot(t |c|) - foot(t)) / t.
float cosine_integral_2pi(float c, float decay, float phi, float inverse_sharpness, vec2 width) {
  float up = 1.0 - phi;
  float low = decay * (phi - decay);
  float f = max(c, 0.0) + (ramp_foot(width.x * abs(c)) - ramp_foot(width.x)) * width.y;
  return (low + (up - low) * max(f, 0.0)) * inverse_sharpness;
}

// Fluence times cosine_mean().
float received_cosine(Incoming light, float c) {
  vec2 width = ramp_width(light.sharpness, light.inverse_sharpness);
  return light.amplitude * cosine_integral_2pi(c, light.decay, light.phi, light.inverse_sharpness, width);
}

// cosine_mean(c, 1 / deviation^2) for deviations up to 0.25. Absolute error 3e-4: the ramp's width is a polynomial in 1 / sharpness, and
// what is behind the receiver is left out.
float narrow_cosine(float c, float deviation) {
  float x = deviation * deviation;
  float width = (0.707106781 / deviation) * (1.0 + x * (-0.592398813 + x * 0.635590565));
  float inverse_width = 1.41421356 * deviation * (1.0 + x * (0.592997884 - x * 0.325019876));
  return (1.0 - x) * (max(c, 0.0) + ramp_foot(width * abs(c)) * inverse_width);
}

// specular_horizon() of lib/specular_lobe.glsl; `light`: axis in the receiver's local frame. The hemisphere's mass is here
// (1 + tanh(l / 2) erf(t c) / erf(t)) / 2 with the t of the cosine: within 0.01 of vmf_hemisphere(), which has a t of its own. The quotient
// of tanh and erf is a polynomial in e^(-l / 2), fitted to 1e-3.
SpecularHorizon fast_horizon(SpecularReceiver r, vec3 light, float sharpness) {
  vec3 p = vec3(r.mirror.x, 0.0, r.mirror.y) + sharpness * light;
  float l = max(sqrt(dot(p, p)), 0.05);
  float inverse = 1.0 / l;
  float c = clamp(p.z * inverse, -1.0, 1.0);
  float root = exp(-0.5 * min(l, 80.0));
  float decay = root * root;
  float phi = (1.0 - decay) * inverse;
  vec2 width = ramp_width(l, inverse);
  float balance = 1.0 + root * (0.503259515 + root * (0.521286246 + root * (-1.24027186 + root * 0.541653410)));
  float above = fast_erfc(width.x * abs(c));
  float half_mass = 0.5 * balance * (1.0 - above);
  float visible = clamp(0.5 + (c < 0.0 ? -half_mass : half_mass), 0.0, 1.0);
  float cosine = cosine_integral_2pi(c, decay, phi, inverse, width) / max(phi * (1.0 + decay) * visible, 1e-30);
  return SpecularHorizon(visible, clamp(cosine, COS_MIN, 1.0));
}

// specular_vmf_ggx() of lib/specular_lobe.glsl over common denominators. `light`: local; `slope_view`: ggx_slope_cosine of the view.
float fast_specular_ggx(SpecularReceiver r, vec3 light, Incoming incoming, float slope_view) {
  SpecularHorizon horizon = fast_horizon(r, light, incoming.sharpness);
  float spread = (1.0 - r.alpha2) * min(incoming.inverse_sharpness, 1e4);
  float c2 = r.cos_view * r.cos_view;
  float top_par = 2.0 + spread;  // 1 / m_par = top_par / bottom_par
  float bottom_par = 2.0 * r.alpha2 + spread;
  float top_perp = 2.0 * c2 + spread;
  float bottom_perp = 2.0 * r.alpha2 * c2 + spread;
  vec3 h = vec3(r.sin_view, 0.0, r.cos_view) + light;
  vec3 h2 = h * h;
  float hh = max(h2.x + h2.y + h2.z, 1e-8);
  float bottom = bottom_par * bottom_perp;
  float form = h2.x * top_par * bottom_perp + h2.y * top_perp * bottom_par + h2.z * bottom;
  float inverse_form = 1.0 / max(form, bottom * hh);
  float density = (hh * hh) * (bottom * inverse_form) * (sqrt(top_par * top_perp * bottom) * inverse_form);
  float slope = sqrt(r.sin_view * r.sin_view * bottom_par / top_par + c2);

  float z = horizon.cosine;
  float masking = z * (r.cos_view + slope_view);
  float masking_below = slope_view * z + ggx_slope_cosine(r.alpha2, z) * r.cos_view;
  float w = 0.3 * r.across * incoming.inverse_sharpness;  // (1 - w') / w' of the blend's weight w'
  float sum = r.cos_view + slope;
  float scale = w * sum + 2.0 * slope;
  float scale_below = 4.0 * PI * (1.0 + w) * slope * sum;
  return horizon.visible * density * masking * scale / (masking_below * scale_below);
}

// specular_vmf_gaussian() of lib/specular_lobe.glsl with the faster horizon.
float fast_specular_gaussian(SpecularReceiver r, vec3 light, Incoming incoming) {
  SpecularHorizon horizon = fast_horizon(r, light, incoming.sharpness);
  SpecularFilter filtered = specular_filter(r, light, incoming.sharpness);
  float masking = 1.0 / (1.0 + r.view_lambda + smith_lambda(r.ndf, r.alpha2, horizon.cosine));
  float broad = (1.0 + r.view_lambda) * filtered.density / filtered.slope_cosine;

  float variance = 0.5 * min(incoming.inverse_sharpness, 1.0);
  float par = r.alpha2 + variance;
  float perp = r.alpha2 + variance / (r.cos_view * r.cos_view);
  vec3 h = vec3(r.sin_view, 0.0, r.cos_view) + light;
  vec3 h2 = h * h / max(dot(h, h), 1e-8);
  float narrow = exp(-h2.x / par - h2.y / perp) * inversesqrt(par * perp) / (PI * r.cos_view);
  float extended = horizon.visible * masking * mix(broad, narrow, clamp(0.25 * incoming.sharpness - 1.0, 0.0, 1.0));

  float sharp_masking = r.cos_view * (1.0 + r.view_lambda + smith_lambda(r.ndf, r.alpha2, light.z));
  float sharp = light.z > 0.0 ? ndf_density(r.ndf, r.alpha2, h2.x + h2.y, h2.z) / sharp_masking : 0.0;
  return 0.25 * mix(extended, sharp, clamp(1.25 - 12.5 * r.across * incoming.inverse_sharpness, 0.0, 1.0));
}

#endif
