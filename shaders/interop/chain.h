// Markov chains over the texels of an RSM.
#ifndef VSGL_INTEROP_CHAIN_H
#define VSGL_INTEROP_CHAIN_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// Where a chain is: 32-bit fixed point, in its layer's square [0,1)^2.
struct Chain {
  uint x, y;
  uint layer;
};
VSGL_CHECK_SIZE(Chain, 12)

VSGL_INTEROP_END
#endif
