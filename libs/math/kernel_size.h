#pragma once

// Sizes of filter kernels over a density pyramid: the double-precision twin of shaders/lib/kernel_size.glsl,
// whose comments say what each function computes. `texels`: M, of all layers; `share`: T = K / N.

#include "math/sampling.h"

namespace vsgl {

double density_bilinear(const DensityPyramid& density, int level, double x, double y);
double density_trilinear(const DensityPyramid& density, double level, double x, double y);

// [Tokuyoshi 2016, Eq. (3)] the smallest level with 4^l p(l) / M = share; 0 or the top level where there is
// none.
double kernel_level_newton(const DensityPyramid& density, double x, double y, double texels, double share);
// [Tokuyoshi 2016, Alg. 1] 12 iterations in the paper.
double kernel_level_bisection(const DensityPyramid& density, double x, double y, double texels, double share,
                              int iterations);
// [Tokuyoshi 2016, Eq. (1)] from the density p > 0 at the centre.
double kernel_level_density(double p, int top, double texels, double share);

}  // namespace vsgl
