#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/metropolis.glsl"

Chain take_chain() {
  uint x = take_uint();
  uint y = take_uint();
  return Chain(x, y, take_uint());
}
void put(Chain c) { put(c.x); put(c.y); put(c.layer); }

void call() {
  switch (FUNCTION) {
    case 0u: {
      Chain chain = take_chain();
      uint index = take_uint();
      uint step_number = take_uint();
      uint low = take_uint();
      uint high = take_uint();
      float large_step = take();
      uint layers = take_uint();
      Proposal next = chain_propose(chain, index, step_number, uvec2(low, high), large_step, layers, take_int());
      put(next.chain);
      put(next.threshold);
      break;
    }
    case 1u: {
      float p = take();
      float proposed = take();
      put(uint(chain_accepts(p, proposed, take())));
      break;
    }
    case 2u: {
      Chain chain = take_chain();
      int top = take_int();
      put(uint(chain_texel(chain, top).x));
      put(uint(chain_texel(chain, top).y));
      put(chain_point(chain, top));
      put(chain_at(chain.layer, chain_texel(chain, top), chain_point(chain, top), top));
      break;
    }
  }
}
