#pragma once

// Functions of one float32 lane for loops that the compiler turns into vectors: arithmetic and square roots
// alone, so that every processor gives the same bytes. Errors are those of the fits; they are for decisions,
// not for pictures. Private to this library.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

// The vectoriser sees only what is inlined.
#define VSGL_LANE [[gnu::always_inline]] inline

namespace vsgl::lane {

struct V3 {
  float x, y, z;
};
VSGL_LANE V3 operator+(V3 a, V3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
VSGL_LANE V3 operator-(V3 a, V3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
VSGL_LANE V3 operator*(float s, V3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
VSGL_LANE float dot(V3 a, V3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Those of the standard library take references, which the vectoriser cannot always look through.
VSGL_LANE float least(float a, float b) {
  return a < b ? a : b;
}
VSGL_LANE float most(float a, float b) {
  return a > b ? a : b;
}
VSGL_LANE float clamp(float x, float low, float high) {
  return least(most(x, low), high);
}
VSGL_LANE float square(float x) {
  return x * x;
}

// e^-x for x >= 0; 2^-126 from 87 on. Relative error 3e-6.
VSGL_LANE float exp_minus(float x) {
  const float y = least(x, 87.0f) * 1.44269504f;
  const auto whole = static_cast<std::int32_t>(y);
  const float f = y - static_cast<float>(whole);
  const float p =
      1 + f * (-0.69306356f + f * (0.2394567f + f * (-0.0532235f + f * 0.00683186f)));  // 2^-f, minimax
  return std::bit_cast<float>((127 - whole) << 23) * p;
}

// -log(1 - x) for 0 <= x <= 1 - 1e-12. Relative error 1e-5.
VSGL_LANE float minus_log_of_rest(float x) {
  const float z = x / (2 - x), z2 = z * z;  // 2 artanh(z)
  const float series = 2 * z * (1 + z2 * (1.0f / 3 + z2 * 0.2f));
  const auto bits = std::bit_cast<std::int32_t>(most(1 - x, 1e-12f));
  const float m = std::bit_cast<float>((bits & 0x7FFFFF) | 0x3F800000) - 1;
  const float log_of_mantissa =  // log(1 + m), minimax
      m * (0.9999916f +
           m * (-0.49936125f + m * (0.32520577f + m * (-0.21004616f + m * (0.10121941f - m * 0.02386801f)))));
  const float by_exponent = static_cast<float>(127 - (bits >> 23)) * 0.69314718f - log_of_mantissa;
  return x < 0.25f ? series : by_exponent;
}

VSGL_LANE float eighth_power(float p) {
  return square(square(square(p)));
}
// erfc(x) for x >= 0 and e^(-x^2) / (2 sqrt(pi)) - x erfc(x) / 2: the fits of shaders/kernels/fused.glsl.
// Absolute errors 8e-6 and 1e-6.
VSGL_LANE float fast_erfc(float x) {
  const float y = least(x, 4.0f);
  return eighth_power(
      1 + y * (-0.141047396f +
               y * (-0.0695034639f + y * (-0.00282007664f + y * (0.00803070935f - y * 0.00107486658f)))));
}
VSGL_LANE float ramp_foot(float x) {
  const float y = least(x, 4.0f);
  return eighth_power(
      0.853688407f +
      y * (-0.189140413f +
           y * (-0.0398918388f + y * (0.00261670626f + y * (0.00437063948f - y * 0.000656774906f)))));
}

// What integrals over an SG share. The sharpness is at least 0.02 (an SG is constant to 2%), so that nothing
// cancels.
struct Lobe {
  float sharpness, inverse;
  float decay, phi;          // e^-sharpness and (1 - e^-sharpness) / sharpness
  float ramp, inverse_ramp;  // t of [Tokuyoshi 2024]
};
VSGL_LANE Lobe lobe_of(float sharpness) {
  const float l = clamp(sharpness, 0.02f, 1e8f), inverse = 1 / l, decay = exp_minus(l);
  // From 1e5 on t^2 / sharpness is constant to 1e-5.
  const float m = least(l, 1e5f), numerator = m * ((m + 2.7360831611f) * m + 17.0212977817f);
  const float denominator = ((2 * m + 8.0201653458f) * m + 30.4383125262f) * m + 152.1757925448f;
  const float quotient = numerator / denominator, ramp = std::sqrt(l * quotient);
  return {l, inverse, decay, (1 - decay) * inverse, ramp, 1 / ramp};
}
// Of the SG of amplitude 1 over 2 pi.
VSGL_LANE float mass_2pi(const Lobe& lobe) {
  return lobe.phi * (1 + lobe.decay);
}
// [Tokuyoshi 2024] Integral of the SG times max(w.n, 0) over 2 pi, c = axis.n.
VSGL_LANE float cosine_integral_2pi(const Lobe& lobe, float c) {
  const float up = 1 - lobe.phi, low = lobe.decay * (lobe.phi - lobe.decay);
  const float f =
      most(c, 0) + (ramp_foot(lobe.ramp * std::abs(c)) - ramp_foot(lobe.ramp)) * lobe.inverse_ramp;
  return (low + (up - low) * most(f, 0)) * lobe.inverse;
}

// [Heitz 2014] c (1 + 2 Lambda) of GGX, finite at c = 0, and Smith's Lambda of Beckmann, which Phong takes.
VSGL_LANE float ggx_slope(float alpha2, float c) {
  return std::sqrt(c * c + alpha2 * most(1 - c * c, 0));
}
VSGL_LANE float beckmann_lambda(float alpha2, float c) {
  const float a = most(c, 1e-4f) / std::sqrt(most(alpha2 * (1 - c * c), 1e-12f));
  return ramp_foot(a) / a;
}

}  // namespace vsgl::lane
