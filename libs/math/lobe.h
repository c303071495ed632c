#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interop/lobe_filter.h"
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

// [Laurijssen 2010] the cubic of lobe_encode() in closed form, and back from |mean| alone; for comparison. In
// double precision relative error of the sharpness 1e-10 at 1e3 and 1e-6 at 1e5.
LobeMoments laurijssen_encode(Vec3 axis, double sharpness);
SgLobe laurijssen_decode(const LobeMoments& moments);

// By a map LOBE_* of interop/lobe_filter.h; LOBE_NONE as LOBE_BANERJEE.
LobeMoments lobe_encode_by(std::uint32_t filter, Vec3 axis, double sharpness);
SgLobe lobe_decode_by(std::uint32_t filter, const LobeMoments& moments);

// "banerjee", "toksvig", "laurijssen", "none"; throws bad_value for other names.
std::vector<std::string> lobe_filter_names();
std::uint32_t lobe_filter_kind(const std::string& name);

}  // namespace vsgl
