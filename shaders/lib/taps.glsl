// Bilinear look-ups in square images held in buffers.
#ifndef VSGL_LIB_TAPS_GLSL
#define VSGL_LIB_TAPS_GLSL

// The four texels around a position in [0,1]^2, clamped to the edge.
struct BilinearTaps {
  ivec2 base, next;
  vec2 fraction;
};
BilinearTaps bilinear_taps(vec2 position, int size) {
  const vec2 texel = position * float(size) - 0.5;
  const vec2 lower = floor(texel);
  BilinearTaps taps;
  taps.base = clamp(ivec2(lower), ivec2(0), ivec2(size - 1));
  taps.next = clamp(ivec2(lower) + 1, ivec2(0), ivec2(size - 1));
  taps.fraction = texel - lower;
  return taps;
}

// Tap k = 0..3 in the order 00, 10, 01, 11, and its weight.
ivec2 tap_texel(BilinearTaps taps, int k) {
  return ivec2((k & 1) == 0 ? taps.base.x : taps.next.x, (k & 2) == 0 ? taps.base.y : taps.next.y);
}
float tap_weight(BilinearTaps taps, int k) {
  return ((k & 1) == 0 ? 1.0 - taps.fraction.x : taps.fraction.x) *
         ((k & 2) == 0 ? 1.0 - taps.fraction.y : taps.fraction.y);
}

// Where a level of a pyramid (libs/math/pyramid.h) begins, in texels.
uint pyramid_offset(int size, int level) {
  const uint whole = uint(size), side = uint(size >> level);
  return 4u * ((whole * whole - side * side) / 3u);
}

#endif
