#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/special.glsl"

void call() {
  switch (FUNCTION) {
    case 0u: put(expm1(take())); break;
    case 1u: put(phi(take())); break;
    case 2u: put(erfc_scaled(take())); break;
    case 3u: put(erfc(take())); break;
  }
}
