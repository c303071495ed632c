#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/subdivision.glsl"

void call() {
  switch (FUNCTION) {
    case 0u: put(integer_root(take_uint())); break;
    case 1u: {
      uint k = take_uint(), cell = take_uint();
      put(subdivision_point(k, cell, take2()));
      break;
    }
  }
}
