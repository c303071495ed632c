// Weighted merging of the moments of reflecting points: mip steps (4 taps) and trilinear look-ups (8 taps) alike.
#ifndef VSGL_LIB_MOMENTS_GLSL
#define VSGL_LIB_MOMENTS_GLSL

#include "interop/moments.h"

// Running mean and spread (total central second moment) of weighted points. The mean is kept as an offset from the first point with
// weight, so that a cluster far from the origin keeps its digits.
struct MeanSpread {
  float weight;
  vec3 reference;
  vec3 offset;
  float spread;
};

MeanSpread mean_spread_start() {
  return MeanSpread(0.0, vec3(0.0), vec3(0.0), 0.0);
}

// Law of total variance in pairs (Chan, Golub and LeVeque 1983): exact, never negative, nothing cancels. Weight 0 changes nothing.
void mean_spread_add(inout MeanSpread a, float weight, vec3 mean, float spread) {
  a.reference = a.weight > 0.0 ? a.reference : mean;
  float total = a.weight + weight;
  float inverse = total > 0.0 ? 1.0 / total : 0.0;
  float before = a.weight * inverse;
  float now = weight * inverse;
  vec3 d = (mean - a.reference) - a.offset;
  a.weight = total;
  a.offset += now * d;
  a.spread = before * a.spread + now * spread + before * now * dot(d, d);
}

vec3 mean_spread_mean(MeanSpread a) {
  return a.weight > 0.0 ? a.reference + a.offset : vec3(0.0);
}

// Moments being merged.
struct MomentsSum {
  vec3 flux, power_diffuse, power_specular;
  MeanSpread position, diffuse, specular, normal;
};

float moments_luminance(vec3 c) {
  return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

MomentsSum moments_start() {
  MeanSpread empty = mean_spread_start();
  return MomentsSum(vec3(0.0), vec3(0.0), vec3(0.0), empty, empty, empty, empty);
}

// Adds a tap of weight `share` (the shares of all taps sum to 1). Deficits merge as spreads do, since
// 1 - |mean|^2 = sum of (1 - |m_k|^2) + |m_k - mean|^2, weighted.
void moments_add(inout MomentsSum a, Moments tap, float share) {
  a.flux += share * tap.flux;
  a.power_diffuse += share * tap.power_diffuse;
  a.power_specular += share * tap.power_specular;
  mean_spread_add(a.position, share * tap.weight, tap.position, tap.spread);
  mean_spread_add(a.normal, share * tap.weight, tap.normal_mean, tap.normal_deficit);
  mean_spread_add(a.diffuse, share * moments_luminance(tap.power_diffuse), tap.diffuse_mean, tap.diffuse_deficit);
  mean_spread_add(a.specular, share * moments_luminance(tap.power_specular), tap.specular_mean, tap.specular_deficit);
}

// The merged moments; statistics without weight are 0.
Moments moments_finish(MomentsSum a) {
  Moments m;
  m.flux = a.flux;
  m.power_diffuse = a.power_diffuse;
  m.power_specular = a.power_specular;
  m.weight = a.position.weight;
  m.position = mean_spread_mean(a.position);
  m.spread = a.position.spread;
  m.diffuse_mean = mean_spread_mean(a.diffuse);
  m.diffuse_deficit = a.diffuse.spread;
  m.specular_mean = mean_spread_mean(a.specular);
  m.specular_deficit = a.specular.spread;
  m.normal_mean = mean_spread_mean(a.normal);
  m.normal_deficit = a.normal.spread;
  return m;
}

// One mip step: the block's four moments in the order 00, 10, 01, 11.
Moments moments_merge(Moments taps[4]) {
  MomentsSum sum = moments_start();
  for (int i = 0; i < 4; ++i) moments_add(sum, taps[i], 0.25);
  return moments_finish(sum);
}

#endif
