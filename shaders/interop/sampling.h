// Sample points and the filter kernels centred on them.
#ifndef VSGL_INTEROP_SAMPLING_H
#define VSGL_INTEROP_SAMPLING_H
#include "interop/interop.h"

VSGL_INTEROP_BEGIN

// Low-discrepancy and random points of the unit square.
VSGL_CONST uint POINTS_LATTICE = 0u;    // rank-1 lattice of a searched generator
VSGL_CONST uint POINTS_FIBONACCI = 1u;  // golden ratio
VSGL_CONST uint POINTS_RANDOM = 2u;     // counter-based hash

VSGL_CONST uint MAX_POINTS = 1048576u;

// A point set; make_point_set() of math/sampling.h fills it. Coordinates are 32-bit fixed point until the
// very last step: float32 products such as i * 0.618 have 6067 distinct fractions among 2^20.
struct PointSet {
  uint kind;       // POINTS_*
  uint count;      // 1..MAX_POINTS
  uint generator;  // POINTS_LATTICE: v_i = frac(i * generator / count)
  uvec2 rotation;  // Cranley-Patterson: added modulo 1
  uvec2 seed;      // low and high word
};
VSGL_CHECK_SIZE(PointSet, 28)

// How large a filter kernel is and what power its light gets (docs/sampling.md).
VSGL_CONST uint KERNEL_TEXEL = 0u;  // no filter: the sampled texel
VSGL_CONST uint KERNEL_DENSITY =
    1u;  // from the density at the centre [Tokuyoshi 2014; Tokuyoshi 2016, Eq. (1), (4)]
VSGL_CONST uint KERNEL_NEWTON = 2u;     // from the density's integral, exact [Tokuyoshi 2016, Eq. (3), (5)]
VSGL_CONST uint KERNEL_BISECTION = 3u;  // the same by 12 bisections [Tokuyoshi 2016, Alg. 1]

// A filter kernel of mean texel power f has f * power_scale watts.
struct Kernel {
  vec2 centre;        // in its layer, [0,1]^2
  float level;        // mip level, 0 = one texel
  float power_scale;  // texels that the kernel stands for
  uint layer;
  uint texel;  // row-major index of the texel under the centre
};
VSGL_CHECK_SIZE(Kernel, 24)

VSGL_INTEROP_END
#endif
