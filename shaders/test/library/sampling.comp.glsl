#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/sampling.glsl"

#include "test/library/density.glsl"

PointSet take_set() {
  PointSet set;
  set.kind = take_uint();
  set.count = take_uint();
  set.generator = take_uint();
  set.rotation.x = take_uint();
  set.rotation.y = take_uint();
  set.seed.x = take_uint();
  set.seed.y = take_uint();
  return set;
}

void call() {
  switch (FUNCTION) {
    case 0u: put(fraction_bits(take_uint(), take_uint())); break;
    case 1u: put(multiply_mod(take_uint(), take_uint(), take_uint())); break;
    case 2u: put(golden_bits(take_uint())); break;
    case 3u: {
      PointSet set = take_set();
      uvec2 bits = point_bits(set, take_uint());
      put(bits.x);
      put(bits.y);
      break;
    }
    case 4u: {
      vec2 weights = take2();
      float u = take();
      put(float(warp_choose(weights.x, weights.y, u)));
      put(u);
      break;
    }
    case 5u: {
      vec2 point = take2();
      uint layer = warp_layer(LAYERS, TOP, point.x);
      put(vec3(float(layer), vec2(warp_texel(layer, TOP, point))));
      put(point);
      break;
    }
  }
}
