#pragma once

// Progressive rendering: passes with shrinking lights, whose mean converges. docs/render.md.

#include <cstdint>

#include "base/pass.h"

namespace vsgl {

// Squared radius of a light in this pass over that in the first: the product of (j + alpha) / (j + 1) over
// the passes j before it, near passes^(alpha - 1).
// [Knaus 2011], as progressive photon mapping [Hachisuka 2008] shrinks its radii. [Tokuyoshi 2014, Sec. 5]
// multiplies radii by 2/3 each pass: noise would then grow faster than the mean averages it away.
double radius2_scale(const Pass& pass);

// Seed of the pass's sample points; of the first: `seed`.
std::uint64_t pass_seed(std::uint64_t seed, const Pass& pass);

}  // namespace vsgl
