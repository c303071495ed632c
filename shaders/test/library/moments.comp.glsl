#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/moments.glsl"

void put(MeanSpread a) { put(a.weight); put(mean_spread_mean(a)); put(a.spread); }

Moments take_moments() {
  Moments m;
  m.flux = take3();
  m.power_diffuse = take3();
  m.power_specular = take3();
  m.weight = take();
  m.position = take3();
  m.spread = take();
  m.diffuse_mean = take3();
  m.diffuse_deficit = take();
  m.specular_mean = take3();
  m.specular_deficit = take();
  m.normal_mean = take3();
  m.normal_deficit = take();
  return m;
}

void put(Moments m) {
  put(m.flux);
  put(m.power_diffuse);
  put(m.power_specular);
  put(m.weight);
  put(m.position);
  put(m.spread);
  put(m.diffuse_mean);
  put(m.diffuse_deficit);
  put(m.specular_mean);
  put(m.specular_deficit);
  put(m.normal_mean);
  put(m.normal_deficit);
}

// Two weighted points, given as weight, mean and spread.
MeanSpread merge_pair() {
  MeanSpread a = mean_spread_start();
  for (int i = 0; i < 2; ++i) {
    float weight = take();
    vec3 mean = take3();
    mean_spread_add(a, weight, mean, take());
  }
  return a;
}

// Eight taps with shares, as a trilinear look-up has them.
Moments merge_eight() {
  MomentsSum sum = moments_start();
  for (int i = 0; i < 8; ++i) {
    float share = take();
    moments_add(sum, take_moments(), share);
  }
  return moments_finish(sum);
}

Moments merge_four() {
  Moments taps[4];
  for (int i = 0; i < 4; ++i) taps[i] = take_moments();
  return moments_merge(taps);
}

void call() {
  switch (FUNCTION) {
    case 0u: put(merge_pair()); break;
    case 1u: put(moments_luminance(take3())); break;
    case 2u: put(merge_eight()); break;
    case 3u: put(merge_four()); break;
  }
}
