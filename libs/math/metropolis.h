#pragma once

// Mutations of Markov chains over the texels of an RSM: the twin of shaders/lib/metropolis.glsl, bit by bit.

#include <array>
#include <cstdint>

#include "interop/chain.h"

namespace vsgl {

// Where a mutation would take a chain, and the random number, [0,1), that decides on it.
struct Proposal {
  interop::Chain chain;
  float threshold = 0;
};

// Mutation `step` of chain `index`: with probability `large_step` to anywhere in any layer, else within the
// square of 16 texels about it, on the torus. `top`: mip level of one texel.
Proposal chain_propose(const interop::Chain& chain, std::uint32_t index, std::uint32_t step,
                       std::uint64_t seed, float large_step, std::uint32_t layers, int top);

// [Metropolis 1953] Whether a chain goes from density p to `proposed`.
bool chain_accepts(float p, float proposed, float threshold);

// Column and row, and where in the texel, [0,1)^2.
std::array<std::uint32_t, 2> chain_texel(const interop::Chain& chain, int top);
std::array<double, 2> chain_point(const interop::Chain& chain, int top);
interop::Chain chain_at(std::uint32_t layer, std::array<std::uint32_t, 2> texel, std::array<double, 2> point,
                        int top);

}  // namespace vsgl
