// Sizes of filter kernels over a density pyramid. Twin: libs/math/kernel_size.h; derivation: docs/sampling.md.
//
// Symbols: l = mip level; p(l) = density averaged by trilinear taps at the kernel's centre; M = texels of all layers;
// F(l) = 4^l p(l) / M = the samples' share that falls into the kernel, target T = K / N.
#ifndef VSGL_LIB_KERNEL_SIZE_GLSL
#define VSGL_LIB_KERNEL_SIZE_GLSL
#include "lib/sampling.glsl"
#include "lib/taps.glsl"

float density_bilinear(uint layer, int level, int top, vec2 position) {
  const BilinearTaps taps = bilinear_taps(position, 1 << (top - level));
  float sum = 0.0;
  for (int k = 0; k < 4; ++k) sum += tap_weight(taps, k) * density_at(layer, level, tap_texel(taps, k));
  return sum;
}

float density_trilinear(uint layer, float level, int top, vec2 position) {
  const int finer = min(int(level), top);
  const float fine = density_bilinear(layer, finer, top, position);
  if (finer == top) return fine;
  return mix(fine, density_bilinear(layer, finer + 1, top, position), level - float(finer));
}

// The root s in [0, 1] of 4^s (a + (b - a) s) = c, where a < c <= 4 b, by 6 Newton steps. Both branches converge monotonically:
// for b >= a the left side is convex and starts from the right; else its logarithm is concave and starts from the left.
// Error: |residual| <= 3e-5 c (tests/unit/lights/kernel_size_test.cpp).
float kernel_fraction(float a, float b, float c) {
  const float ln4 = 1.38629436;
  const float slope = b - a;
  float s = slope >= 0.0 ? 1.0 : 0.0;
  for (int step = 0; step < 6; ++step) {
    const float p = a + slope * s;
    if (slope >= 0.0) {
      const float power = exp2(2.0 * s);
      s -= (power * p - c) / (power * (ln4 * p + slope));
    } else {
      s -= (ln4 * s + log(p / c)) / (ln4 + slope / p);
    }
  }
  return clamp(s, 0.0, 1.0);
}

// [Tokuyoshi 2016, Eq. (3)] the smallest level whose kernel holds the share T of the samples.
// Deviation: walks up the integer levels and solves within the bracket instead of 12 bisections over all levels: F is not
// monotone for trilinear taps, so bisection may return a later root, and it errs by up to 1e-3 levels.
float kernel_level_newton(uint layer, int top, vec2 position, float texels, float share) {
  float p = density_bilinear(layer, 0, top, position);
  float wanted = share * texels;  // T M / 4^level
  if (p >= wanted) return 0.0;
  for (int level = 0; level < top; ++level) {
    const float next = density_bilinear(layer, level + 1, top, position);
    if (4.0 * next >= wanted) return float(level) + kernel_fraction(p, next, wanted);
    p = next;
    wanted *= 0.25;
  }
  return float(top);
}

// [Tokuyoshi 2016, Alg. 1] the same by bisection, as printed.
float kernel_level_bisection(uint layer, int top, vec2 position, float texels, float share, int iterations) {
  float lower = 0.0, upper = float(top);
  for (int step = 0; step < iterations; ++step) {
    const float level = 0.5 * (lower + upper);
    const float held = exp2(2.0 * level) / texels * density_trilinear(layer, level, top, position);
    if (held < share)
      lower = level;
    else
      upper = level;
  }
  return 0.5 * (lower + upper);
}

// [Tokuyoshi 2016, Eq. (1)], which is h of [Tokuyoshi 2014, section 3.2]: from the density p at the centre alone.
// Deviation: clamped to [0, top] on both sides.
float kernel_level_density(float p, int top, float texels, float share) {
  return clamp(0.5 * log2(share * texels / p), 0.0, float(top));
}

#endif
