#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"

// Elementary functions and operators of the device (tests/stability/arithmetic_test.cpp).
void call() {
  float x = take(), y = take(), z = take();
  switch (FUNCTION) {
    case 0u: put(exp(x)); break;
    case 1u: put(exp2(x)); break;
    case 2u: put(log(x)); break;
    case 3u: put(log2(x)); break;
    case 4u: put(sqrt(x)); break;
    case 5u: put(inversesqrt(x)); break;
    case 6u: put(x / y); break;
    case 7u: put(pow(x, y)); break;
    case 8u: put(sin(x)); break;
    case 9u: put(cos(x)); break;
    case 10u: put(atan(x, y)); break;
    case 11u: put(acos(x)); break;
    case 12u: put(x * y + z); break;
    case 13u: put(fma(x, y, z)); break;
    case 14u: put(ldexp(x, int(y))); break;
  }
}
