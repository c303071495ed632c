#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/fvpl.glsl"

// Without position, children, light and padding, in the order of interop/cluster.h.
Cluster take_cluster() {
  Cluster c;
  c.position = vec3(0.0);
  c.inverse_variance = take();
  c.normal = take3();
  c.normal_sharpness = take();
  c.diffuse = take3();
  c.incident_masking = take();
  c.shading_normal = take3();
  c.facet_turn = take();
  c.incident = take3();
  c.alpha2 = take();
  c.specular = take3();
  c.masking_alpha2 = take();
  c.ndf = take_uint();
  return c;
}

SpecularReceiver take_receiver() {
  uint ndf = take_uint();
  float alpha = take();
  vec3 normal = take3();
  return specular_receiver(ndf, alpha, normal, take3());
}

void put(FvplView v) { put(v.u); put(v.d2); put(v.inverse_d2); put(v.sharpness); }

void put_specular(Cluster c) {
  vec3 w = take3();
  float inverse_d2 = take();
  put(fvpl_specular(c.ndf, c, w, inverse_d2, take()));
}

Cluster take_plane() {
  Cluster c;
  c.inverse_variance = take();
  c.normal = take3();
  c.normal_sharpness = take();
  return c;
}

void put_reflection(SpecularReceiver r, bool extended) {
  vec3 v = take3();
  Cluster c = take_plane();
  FvplView view = fvpl_view(v, c.inverse_variance);
  put(extended ? fvpl_extended(r, c, view) : fvpl_point(r, c, view));
}

void put_plane(Cluster c) {
  vec3 u = take3();
  vec3 normal = take3();
  float cosine = take();
  float inverse_sharpness = take();
  put(fvpl_plane(c, u, normal, cosine, inverse_sharpness, take()));
}

void call() {
  switch (FUNCTION) {
    case 0u: put(fvpl_view(take3(), take())); break;
    case 1u: put(uint(fvpl_is_point(take(), take()))); break;
    case 2u: put(fvpl_cosine(take(), take())); break;
    case 3u: put_specular(take_cluster()); break;
    case 4u: put(fvpl_emission_diffuse(take_cluster(), take3())); break;
    case 5u: { Cluster c = take_cluster(); put(fvpl_emission_flat(c.ndf, c, take3(), take())); break; }
    case 6u: { Cluster c = take_cluster(); put(fvpl_emission(c.ndf, c, take3(), take())); break; }
    case 7u: put_reflection(take_receiver(), false); break;
    case 8u: put(fvpl_fluence(take(), take())); break;
    case 9u: put_reflection(take_receiver(), true); break;
    case 10u: put_plane(take_plane()); break;
    case 11u: put(ggx_spread_d(take(), take(), take(), take())); break;
  }
}
