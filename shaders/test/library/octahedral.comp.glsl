#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/octahedral.glsl"

void call() {
  switch (FUNCTION) {
    case 0u: put(hemi_octahedral_encode(take3())); break;
    case 1u: put(hemi_octahedral_point(take2())); break;
    case 2u: put(hemi_octahedral_decode(take2())); break;
    case 3u: put(hemi_octahedral_solid_angle(take2(), take())); break;
  }
}
