#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/kernel_size.glsl"

#include "test/library/density.glsl"

void call() {
  switch (FUNCTION) {
    case 0u: {
      uint layer = take_uint();
      int level = take_int();
      put(density_bilinear(layer, level, TOP, take2()));
      break;
    }
    case 1u: {
      uint layer = take_uint();
      float level = take();
      put(density_trilinear(layer, level, TOP, take2()));
      break;
    }
    case 2u: put(kernel_fraction(take(), take(), take())); break;
    case 3u: {
      uint layer = take_uint();
      put(kernel_level_newton(layer, TOP, take2(), float(LAYERS * SIZE * SIZE), take()));
      break;
    }
    case 4u: {
      uint layer = take_uint();
      put(kernel_level_bisection(layer, TOP, take2(), float(LAYERS * SIZE * SIZE), take(), 12));
      break;
    }
    case 5u: put(kernel_level_density(take(), TOP, float(LAYERS * SIZE * SIZE), take())); break;
  }
}
