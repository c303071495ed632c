#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/taps.glsl"

void call() {
  switch (FUNCTION) {
    case 0u: {
      vec2 position = take2();
      BilinearTaps taps = bilinear_taps(position, take_int());
      for (int k = 0; k < 4; ++k) {
        put(vec2(tap_texel(taps, k)));
        put(tap_weight(taps, k));
      }
      break;
    }
    case 1u: {
      int size = take_int();
      put(pyramid_offset(size, take_int()));
      break;
    }
  }
}
