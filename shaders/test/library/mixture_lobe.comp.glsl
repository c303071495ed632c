#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/mixture_lobe.glsl"

SpecularReceiver take_receiver() {
  uint ndf = take_uint();
  float alpha = take();
  vec3 normal = take3();
  return specular_receiver(ndf, alpha, normal, take3());
}

void put(MixtureSpread s) { put(vec2(s.par, s.perp)); put(vec2(s.broad, s.plane)); }
void put(MixtureSplit s) { put(vec2(s.x, s.tau)); }

void put_peak(SpecularReceiver r, vec3 light, float sharpness) {
  MixturePeak p = mixture_peak(r, mixture_spread(r, sharpness), light, sharpness, mixture_half_vector(r, light), 0.5, 1.0);
  put(p.h);
  put(p.cos2);
  put(exp(-p.exponent));
  put(p.scale);
}

void call_of_light() {
  SpecularReceiver r = take_receiver();
  vec3 axis = take3();
  vec3 light = specular_local(r, axis);
  float sharpness = take();
  MixtureSpread s = mixture_spread(r, sharpness);
  vec2 h = mixture_half_vector(r, light);
  switch (FUNCTION) {
    case 1u: put(s); break;
    case 2u: put(h); break;
    case 3u: put(mixture_split(r, sharpness)); break;
    case 4u: put_peak(r, light, sharpness); break;
    case 5u: put(mixture_tail(s, mixture_split(r, sharpness).x, h * h)); break;
    case 6u: put(mixture_density(r, light, sharpness)); break;
    case 7u: put(specular_vmf_mixture(r, axis, sharpness)); break;
    case 8u: put(mixture_turn(r, light, h, 0.7 * h, sqrt(1.0 - 0.49 * dot(h, h)))); break;
  }
}

void call() {
  switch (FUNCTION) {
    case 0u: put(mixture_incomplete(take())); break;
    case 9u: put(mixture_direction(take_uint(), take())); break;
    default: call_of_light();
  }
}
