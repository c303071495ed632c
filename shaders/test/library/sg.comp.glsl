#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/sg.glsl"

// The axis as far as the lobes agree on it: times |l1 a1 + l2 a2| / (l1 + l2).
SgProduct product() {
  vec3 axis = take3();
  float sharpness = take();
  vec3 other = take3();
  float other_sharpness = take();
  SgProduct p = sg_product(axis, sharpness, other, other_sharpness);
  p.axis *= p.sharpness / max(sharpness + other_sharpness, 1e-30);
  return p;
}
void put(SgProduct p) { put(p.axis); put(p.sharpness); put(p.exponent); }

void call() {
  switch (FUNCTION) {
    case 0u: put(sg_value(take3(), take3(), take())); break;
    case 1u: put(sg_integral(take())); break;
    case 2u: put(product()); break;
    case 3u: put(vmf_hemisphere(take(), take())); break;
    case 4u: put(cosine_mean(take(), take())); break;
    case 5u: put(cosine_integral(take(), take())); break;
  }
}
