// How lobes are averaged.
#ifndef VSGL_INTEROP_LOBE_FILTER_H
#define VSGL_INTEROP_LOBE_FILTER_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// The map between a lobe's sharpness and the length of its mean direction (docs/sampling.md).
VSGL_CONST uint LOBE_BANERJEE = 0u;    // cubic, with the deficit 1 - length^2 kept apart; that of RSMs
VSGL_CONST uint LOBE_TOKSVIG = 1u;     // length = sharpness / (sharpness + 1)
VSGL_CONST uint LOBE_LAURIJSSEN = 2u;  // the same cubic, solved in closed form, from the length alone
VSGL_CONST uint LOBE_NONE = 3u;        // not averaged: the lobe of the sampled texel

VSGL_INTEROP_END
#endif
