// Sharpness of a lobe as the moments of its directions, so that lobes can be averaged. With r = |mean direction|, the moments are
// `mean` = r axis and `deficit` = 1 - r^2, kept apart so that sharp lobes keep their digits.
#ifndef VSGL_LIB_LOBE_GLSL
#define VSGL_LIB_LOBE_GLSL

#include "interop/lobe_filter.h"
#include "lib/constants.glsl"
#include "lib/sg.glsl"

struct LobeMoments {
  vec3 mean;
  float deficit;
};

// 1 - r for sharpness 0..2^40, inverse of the Banerjee pair r (3 - r^2) / (1 - r^2) = sharpness [Laurijssen 2010]. Relative error 2e-7.
// Deviation: Newton's method on the cubic in 1 - r; its closed solution by cosines loses all digits of 1 - r from 1e5 on.
float lobe_one_minus_length(float sharpness) {
  float l = sharpness;
  float e = l < 1.0 ? 1.0 / (1.0 + l / 3.0) : 1.0 / (l + 0.5);
  for (int i = 0; i < 4; ++i) {
    float value = (e * e * (e - 3.0) + 2.0) + l * e * (e - 2.0);
    float slope = 3.0 * e * (e - 2.0) + 2.0 * l * (e - 1.0);
    e = clamp(e - value / slope, 0.0, 1.0);
  }
  return e;
}

// Moments of the normalised SG. Sharpness through encode and decode: relative error 1e-6 for 1e-3..2^40.
// The length comes from the inverse map, so that broad lobes keep their digits, too.
LobeMoments lobe_encode(vec3 axis, float sharpness) {
  float e = lobe_one_minus_length(sharpness);
  float deficit = e * (2.0 - e);
  return LobeMoments(sharpness * (deficit / (2.0 + deficit)) * axis, deficit);
}

// Sharpness of mean length r = sqrt(1 - deficit) and deficit: at most 2^40.
float lobe_sharpness(float r, float deficit) {
  return min(r * (2.0 + deficit) / max(deficit, 1e-30), SHARPNESS_MAX);
}

// Axis and sharpness of averaged moments. Without a mean direction the axis is +z and the sharpness 0.
SgLobe lobe_decode(LobeMoments moments) {
  float r2 = dot(moments.mean, moments.mean);
  float inverse = inversesqrt(max(r2, 1e-36));
  bool directed = r2 > 1e-36;
  return SgLobe(directed ? moments.mean * inverse : vec3(0.0, 0.0, 1.0),
                directed ? lobe_sharpness(r2 * inverse, moments.deficit) : 0.0);
}

// [Toksvig 2005] as the VSGL papers use it: r = sharpness / (sharpness + 1), in deficit form. For comparison with the papers.
LobeMoments toksvig_encode(vec3 axis, float sharpness) {
  float e = 1.0 / (1.0 + sharpness);
  return LobeMoments((sharpness * e) * axis, e * (2.0 - e));
}

// r / (1 - r) = r (1 + r) / deficit.
SgLobe toksvig_decode(LobeMoments moments) {
  float r2 = dot(moments.mean, moments.mean);
  float inverse = inversesqrt(max(r2, 1e-36));
  bool directed = r2 > 1e-36;
  float r = r2 * inverse;
  float sharpness = min(r * (1.0 + r) / max(moments.deficit, 1e-30), SHARPNESS_MAX);
  return SgLobe(directed ? moments.mean * inverse : vec3(0.0, 0.0, 1.0), directed ? sharpness : 0.0);
}

// [Laurijssen 2010] the cubic r^3 - l r^2 - 3 r + l = 0 in closed form: its root in 0..1 by Viete's cosines, l = sharpness. As
// published: r = l / 3 - (nearly as much) loses its digits, to a relative error of the sharpness of 1e-3 at 100, 0.1 at 1e3 and 1 from 3e3
// on.
LobeMoments laurijssen_encode(vec3 axis, float sharpness) {
  float third = sharpness / 3.0;
  float m = sqrt(1.0 + third * third);
  float c = third / m, c2 = c * c;
  float angle = atan(sqrt(1.0 + c2 + c2 * c2) / m, c * c2);  // arc cosine of c^3
  float r = clamp(third + 2.0 * m * cos((angle - 2.0 * PI) / 3.0), 0.0, 1.0);
  return LobeMoments(r * axis, 1.0 - r * r);
}

// From the length alone.
SgLobe laurijssen_decode(LobeMoments moments) {
  float r2 = dot(moments.mean, moments.mean);
  return lobe_decode(LobeMoments(moments.mean, 1.0 - min(r2, 1.0)));
}

// By a map LOBE_*; LOBE_NONE as LOBE_BANERJEE.
LobeMoments lobe_encode_by(uint filter_kind, vec3 axis, float sharpness) {
  switch (filter_kind) {
    case LOBE_TOKSVIG: return toksvig_encode(axis, sharpness);
    case LOBE_LAURIJSSEN: return laurijssen_encode(axis, sharpness);
    default: return lobe_encode(axis, sharpness);
  }
}
SgLobe lobe_decode_by(uint filter_kind, LobeMoments moments) {
  switch (filter_kind) {
    case LOBE_TOKSVIG: return toksvig_decode(moments);
    case LOBE_LAURIJSSEN: return laurijssen_decode(moments);
    default: return lobe_decode(moments);
  }
}

#endif
