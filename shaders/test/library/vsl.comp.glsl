#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/vsl.glsl"

Scatterer take_scatterer() {
  uint ndf = take_uint();
  float alpha2 = take(), specular = take();
  vec3 normal = take3();
  return Scatterer(take3(), normal, normal, alpha2, specular, ndf);
}

void call() {
  switch (FUNCTION) {
    case 0u: put(disk_cone_height(take(), take())); break;
    case 1u: put(sphere_cone_height(take(), take())); break;
    case 2u: put(cone_direction(take3(), take(), take2())); break;
    case 3u: {
      uint ndf = take_uint();
      float alpha2 = take();
      put(microfacet_sin2(ndf, alpha2, take()) / alpha2);
      break;
    }
    case 4u: put(scatter_direction(take_scatterer(), take2())); break;
    case 5u: put(scatter_pdf(take_scatterer(), take3())); break;
  }
}
