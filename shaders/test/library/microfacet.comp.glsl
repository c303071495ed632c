#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/microfacet.glsl"

void put(SgLobe l) { put(l.axis); put(l.sharpness); }

void call() {
  switch (FUNCTION) {
    case 0u: put(ggx_d(take(), take(), take())); break;
    case 1u: put(beckmann_d(take(), take(), take())); break;
    case 2u: put(phong_d(take(), take(), take())); break;
    case 3u: put(ndf_density(take_uint(), take(), take(), take())); break;
    case 4u: put(ggx_slope_cosine(take(), take())); break;
    case 5u: put(ggx_lambda(take(), take())); break;
    case 6u: put(beckmann_lambda(take(), take())); break;
    case 7u: put(smith_lambda(take_uint(), take(), take())); break;
    case 8u: put(ndf_sharpness(take_uint(), take())); break;
    case 9u: put(specular_brdf_cos(take_uint(), take(), take3(), take3(), take3())); break;
    case 10u: put(dominant_normal(take(), take3(), take3())); break;
    case 11u: put(specular_lobe(take_uint(), take(), take3(), take3())); break;
  }
}
