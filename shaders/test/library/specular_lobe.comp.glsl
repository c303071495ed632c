#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/specular_lobe.glsl"

SpecularReceiver take_receiver() {
  uint ndf = take_uint();
  float alpha = take();
  vec3 normal = take3();
  return specular_receiver(ndf, alpha, normal, take3());
}

void put(SpecularReceiver r) {
  put(r.tangent);
  put(r.bitangent);
  put(r.normal);
  put(vec2(r.sin_view, r.cos_view));
  put(r.alpha2);
  put(r.across);
  put(r.across_cos2);
  put(r.mirror * r.alpha2);  // relative to the lobe's sharpness
  put(r.view_lambda);
}
void put(SpecularHorizon h) { put(h.visible); put(h.visible * h.cosine); }
void put(SpecularFilter f) { put(f.density); put(f.slope_cosine); }

void call() {
  SpecularReceiver r = take_receiver();
  switch (FUNCTION) {
    case 0u: put(r); break;
    case 1u: put(specular_local(r, take3())); break;
    case 2u: put(specular_horizon(r, specular_local(r, take3()), take())); break;
    case 3u: put(specular_filter(r, specular_local(r, take3()), take())); break;
    case 4u: put(specular_vmf_filtered(r, take3(), take())); break;
    case 5u: put(specular_vmf_ggx(r, take3(), take())); break;
    case 6u: put(specular_vmf_gaussian(r, take3(), take())); break;
    case 7u: put(specular_vmf_blend(r, take3(), take())); break;
    case 8u: put(specular_vmf_projected(r, take3(), take())); break;
    case 9u: put(specular_vmf_ndf_filter(r, take3(), take())); break;
  }
}
