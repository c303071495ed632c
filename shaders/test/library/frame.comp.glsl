#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/frame.glsl"

void call() {
  mat3 f = frame_about(take3());
  put(f[0]);
  put(f[1]);
  put(f[2]);
}
