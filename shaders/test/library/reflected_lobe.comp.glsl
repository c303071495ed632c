#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/reflected_lobe.glsl"

SpecularReceiver take_receiver() {
  uint ndf = take_uint();
  float alpha = take();
  vec3 normal = take3();
  return specular_receiver(ndf, alpha, normal, take3());
}

void put(AsgProduct p) { put(p.axis); put(p.exponent); put(p.integral); }

void call() {
  switch (FUNCTION) {
    case 6u: put(asg_product(take3(), take2(), take())); return;
  }
  SpecularReceiver r = take_receiver();
  switch (FUNCTION) {
    case 0u: put(specular_coefficient(r, take())); break;
    case 1u: put(reflected_local(r, take3())); break;
    case 2u: put(reflected_bandwidths(r)); break;
    case 3u: put(specular_vmf_sg(r, take3(), take())); break;
    case 4u: put(specular_asg_convolved(r, take3(), take())); break;
    case 5u: put(specular_vmf_asg(r, take3(), take())); break;
    case 7u: put(specular_vmf_asg_asg(r, take3(), take())); break;
  }
}
