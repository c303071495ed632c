#pragma once

#include "math/sg.h"

// Sharpness of a lobe as the moments of its directions, in double precision: the twin of
// shaders/lib/lobe.glsl.

namespace vsgl {

// With r = |mean direction|: `mean` = r axis, `deficit` = 1 - r^2, kept apart so that sharp lobes keep their
// digits.
struct LobeMoments {
  Vec3 mean;
  double deficit = 0;
};

// 1 - r of the Banerjee pair sharpness = r (3 - r^2) / (1 - r^2) [Laurijssen 2010], for sharpness 0..2^40.
double lobe_one_minus_length(double sharpness);

// Moments of the normalised SG, and back. Without a mean direction the axis is +z and the sharpness 0.
LobeMoments lobe_encode(Vec3 axis, double sharpness);
SgLobe lobe_decode(const LobeMoments& moments);
// Sharpness of mean length r = sqrt(1 - deficit) and deficit, at most 2^40.
double lobe_sharpness(double r, double deficit);

// [Toksvig 2005] as the VSGL papers use it, r = sharpness / (sharpness + 1). For comparison with the papers.
LobeMoments toksvig_encode(Vec3 axis, double sharpness);
SgLobe toksvig_decode(const LobeMoments& moments);

}  // namespace vsgl
