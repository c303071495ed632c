// Sample points and hierarchical sample warping. Twin: libs/math/sampling.h.
//
// The includer defines how the density's mean pyramid is read:
//   float density_at(uint layer, int level, ivec2 texel)
#ifndef VSGL_LIB_SAMPLING_GLSL
#define VSGL_LIB_SAMPLING_GLSL
#include "interop/sampling.h"
#include "lib/hash.glsl"

float density_at(uint layer, int level, ivec2 texel);

const float BELOW_ONE = 0.999999940395355;  // 1 - 2^-24

// floor(2^32 numerator / denominator) by long division, 11 + 11 + 10 binary digits. Domain: numerator < denominator <= 2^21.
uint fraction_bits(uint numerator, uint denominator) {
  const uint shifts[3] = uint[3](11u, 11u, 10u);
  uint bits = 0u;
  for (int step = 0; step < 3; ++step) {
    const uint shifted = numerator << shifts[step];
    bits = (bits << shifts[step]) | (shifted / denominator);
    numerator = shifted % denominator;
  }
  return bits;
}

// (a * b) mod n without overflow. Domain: a, b < n <= 2^20.
uint multiply_mod(uint a, uint b, uint n) {
  return (((a * (b >> 10)) % n) * 1024u + a * (b & 1023u)) % n;
}

// High word of i * 2^64 (sqrt(5) - 1) / 2: the fraction of i times the golden ratio, all 2^20 values distinct.
uint golden_bits(uint i) {
  uint high, low;
  umulExtended(i, 0x7F4A7C15u, high, low);
  return high + i * 0x9E3779B9u;
}

// Point i in 32-bit fixed point. [Tokuyoshi 2016, section 5] uses POINTS_FIBONACCI.
uvec2 point_bits(PointSet set, uint i) {
  if (set.kind == POINTS_RANDOM) return pcg3d(uvec3(i, set.seed.x, set.seed.y)).xy;
  const uint u = fraction_bits(2u * i + 1u, 2u * set.count);
  const uint v = set.kind == POINTS_FIBONACCI
                     ? golden_bits(i)
                     : fraction_bits(multiply_mod(i, set.generator, set.count), set.count);
  return uvec2(u, v) + set.rotation;
}

// Chooses the first of two parts with probability first / (first + second) and stretches u over the chosen one. Returns 0 or 1.
// Never chooses a part of weight 0, unless both are.
int warp_choose(float first, float second, inout float u) {
  const float sum = first + second;
  const float share = sum > 0.0 ? first / sum : 0.5;
  const bool take_first = u < share;
  u = min(take_first ? u / share : (u - share) / (1.0 - share), BELOW_ONE);
  return take_first ? 0 : 1;
}

// The layer in proportion to the means of the layers, u stretched over it. Domain: some layer has a positive mean.
uint warp_layer(uint layers, int top, inout float u) {
  float sum = 0.0;
  for (uint layer = 0u; layer < layers; ++layer) sum += density_at(layer, top, ivec2(0));
  float rest = u * sum;
  uint chosen = 0u;
  float mean = 0.0;
  for (uint layer = 0u; layer < layers; ++layer) {
    const float next = density_at(layer, top, ivec2(0));
    if (next <= 0.0) continue;
    if (mean > 0.0) rest -= mean;
    chosen = layer;
    mean = next;
    if (rest < mean) break;
  }
  u = clamp(rest / mean, 0.0, BELOW_ONE);
  return chosen;
}

// [Clarberg 2005] hierarchical sample warping: the texel of level 0 with probability proportional to its density. On return
// `point` is the position within the texel, [0, 1)^2.
ivec2 warp_texel(uint layer, int top, inout vec2 point) {
  ivec2 texel = ivec2(0);
  for (int level = top - 1; level >= 0; --level) {
    texel *= 2;
    const vec2 column0 = vec2(density_at(layer, level, texel), density_at(layer, level, texel + ivec2(0, 1)));
    const vec2 column1 = vec2(density_at(layer, level, texel + ivec2(1, 0)), density_at(layer, level, texel + ivec2(1, 1)));
    const int i = warp_choose(column0.x + column0.y, column1.x + column1.y, point.x);
    const vec2 column = i == 0 ? column0 : column1;
    const int j = warp_choose(column.x, column.y, point.y);
    texel += ivec2(i, j);
  }
  return texel;
}

#endif
