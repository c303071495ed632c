// What sizes filter kernels over the density of an RSM.
#ifndef VSGL_INTEROP_KERNEL_SETUP_H
#define VSGL_INTEROP_KERNEL_SETUP_H
#include "interop/sampling.h"

VSGL_INTEROP_BEGIN

struct KernelSetup {
  uvec2 densities_at;  // device address of the layers' mean pyramids, one after another
  PointSet points;
  uint rule;    // KERNEL_*
  uint layers;
  uint top;     // level of one texel
  float scale;  // K
};
VSGL_CHECK_SIZE(KernelSetup, 52)

VSGL_INTEROP_END
#endif
