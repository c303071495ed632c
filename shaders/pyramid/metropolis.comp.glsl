// [Barak 2013] Moves Markov chains over the texels of all layers, stationary in the density, and makes the filter kernel about each.
#version 450
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "interop/kernel_setup.h"
#include "lib/metropolis.glsl"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Chains { Chain at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Kernels { Kernel at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Accepted { uint at[]; };
layout(push_constant, scalar) uniform Push {
  KernelSetup setup;
  uvec2 chains_at;
  uvec2 kernels_at;
  uvec2 accepted_at;  // mutations accepted, of each chain
  uint is_new;        // 1: the chains start at the points, warped by the density
  uint first_step, mutations;
  float large_step;  // probability
};

#include "pyramid/kernel.glsl"

Chain start(uint i, int top) {
  vec2 point = point_of_bits(point_bits(setup.points, i));
  const uint layer = warp_layer(setup.layers, top, point.x);
  const ivec2 texel = warp_texel(layer, top, point);
  return chain_at(layer, texel, point, top);
}

float density_of(Chain chain) {
  return density_at(chain.layer, 0, chain_texel(chain, int(setup.top)));
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= setup.points.count) return;
  const int top = int(setup.top);
  Chain chain = is_new != 0u ? start(i, top) : Chains(chains_at).at[i];
  float p = density_of(chain);
  uint accepted = 0u;
  for (uint m = 0u; m < mutations; ++m) {
    const Proposal next = chain_propose(chain, i, first_step + m, setup.points.seed, large_step, setup.layers, top);
    const float proposed = density_of(next.chain);
    if (!chain_accepts(p, proposed, next.threshold)) continue;
    chain = next.chain;
    p = proposed;
    ++accepted;
  }
  Kernel kernel = kernel_about(chain.layer, chain_texel(chain, top), chain_point(chain, top));
  // The density has left the chain: no light, until it finds back.
  if (p <= 0.0) kernel.power_scale = 0.0;
  Chains(chains_at).at[i] = chain;
  Kernels(kernels_at).at[i] = kernel;
  Accepted(accepted_at).at[i] = accepted;
}
