// Mutations of Markov chains over the texels of an RSM. Twin: libs/math/metropolis.h, bit by bit.
#ifndef VSGL_LIB_METROPOLIS_GLSL
#define VSGL_LIB_METROPOLIS_GLSL
#include "interop/chain.h"
#include "lib/hash.glsl"

const int SMALL_STEP = 4;  // log2 of the texels that a small step's square is wide

struct Proposal {
  Chain chain;
  float threshold;  // [0, 1): the random number that decides on it
};

// Mutation `step` of chain `index`: with probability `large_step` to anywhere in any layer, else within the square of 16 texels about it,
// which continues at the opposite edge. Both are symmetric: there and back are equally likely.
Proposal chain_propose(Chain chain, uint index, uint step, uvec2 seed, float large_step, uint layers, int top) {
  const uvec3 key = pcg3d(uvec3(step, seed));
  const uvec3 a = pcg3d(uvec3(index, key.xy)), b = pcg3d(uvec3(index, key.yz));
  const vec2 chance = point_of_bits(uvec2(a.z, b.y));
  if (chance.x < large_step) {
    uint layer, rest;
    umulExtended(b.x, layers, layer, rest);
    return Proposal(Chain(a.x, a.y, layer), chance.y);
  }
  const ivec2 offset = ivec2(a.xy) >> max(top - SMALL_STEP, 0);
  return Proposal(Chain(chain.x + uint(offset.x), chain.y + uint(offset.y), chain.layer), chance.y);
}

// [Metropolis 1953] Whether a chain goes from density p to `proposed`: with probability min(1, proposed / p); from where there is none
// it goes anywhere.
bool chain_accepts(float p, float proposed, float threshold) {
  return p <= 0.0 || threshold * p < proposed;
}

ivec2 chain_texel(Chain chain, int top) {
  return ivec2((uvec2(chain.x, chain.y) >> 1u) >> uint(31 - top));
}

// Where in its texel, [0, 1)^2.
vec2 chain_point(Chain chain, int top) {
  return point_of_bits(uvec2(chain.x, chain.y) << uint(top));
}

// At a point of a texel. (ldexp is exact on every device; exp2 of a whole number need not be.)
Chain chain_at(uint layer, ivec2 texel, vec2 point, int top) {
  const uvec2 at = ((uvec2(texel) << uint(31 - top)) << 1u) | uvec2(ldexp(point, ivec2(32 - top)));
  return Chain(at.x, at.y, layer);
}

#endif
