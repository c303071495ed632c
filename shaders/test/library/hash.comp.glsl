#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/hash.glsl"

void call() {
  uvec3 v = pcg3d(uvec3(take_uint(), take_uint(), take_uint()));
  put(v.x);
  put(v.y);
  put(v.z);
  put(point_of_bits(v.xy));
  uvec2 bits = r2_bits(v.z);
  put(bits.x);
  put(bits.y);
}
