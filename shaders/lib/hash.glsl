// Hashed words, and points in the unit square from words. Twin: libs/math/sampling.h.
#ifndef VSGL_LIB_HASH_GLSL
#define VSGL_LIB_HASH_GLSL

// [Jarzynski 2020] PCG3D: a hash of three words to three words.
uvec3 pcg3d(uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  return v;
}

// [Roberts 2018] point k of the sequence R2 in 32-bit fixed point: k times the first two powers of 1 / 1.3247..., the root of
// x^3 = x + 1, modulo 1.
uvec2 r2_bits(uint k) { return k * uvec2(0xC13FA9A9u, 0x91E10DA5u); }

// To [0, 1), exactly: the upper 24 bits.
vec2 point_of_bits(uvec2 bits) { return vec2(bits >> 8u) * 5.9604644775390625e-8; }

#endif
