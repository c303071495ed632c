#pragma once

// Clusters of texels about sampled centres, and the lights that they make. docs/kmeans.md states the
// formulas.

#include <cstdint>
#include <span>
#include <vector>

#include "base/report.h"
#include "gpu/device.h"
#include "interop/kmeans.h"
#include "interop/light.h"
#include "interop/lobe_filter.h"
#include "interop/moments.h"
#include "math/sampling.h"
#include "pyramid/kernels.h"

namespace vsgl {

struct KmeansParams {
  std::uint32_t space = interop::KMEANS_2D;  // KMEANS_2D: clusters never cross layers; KMEANS_3D: they may
  int iterations = 0;                        // of Lloyd's algorithm at most, >= 0
  double normal_weight = 0;                  // >= 0, of the squared distance of normals
  double scene_radius = 1;                   // m
  double variance_floor = 0;                 // of lights, m^2
  std::uint32_t lobe_filter =
      interop::LOBE_BANERJEE;  // LOBE_NONE: the lobes of the texel nearest to the centre
};

// Lit texels, level 0 of the moment pyramids (or all of them) of size x size texels each.
using LayerMoments = std::span<const std::span<const interop::Moments>>;

struct Clusters {
  // One a centre, in their order: what filter_moments() gives, for a cluster; texel and layer are those of
  // the texel nearest to the centre. Clusters without texels give a light of zeros.
  std::vector<interop::Light> lights;
  // Of each texel, layer by layer; the number of centres where nothing reflects.
  std::vector<std::uint32_t> cluster_of;
  double cost = 0;     // sum of weight times squared distance to the centre
  int iterations = 0;  // run
};

// Every texel with weight goes to its nearest centre. `centres`: texels, counted layer by layer. At least
// one; in 2D, of each layer with weight. The same inputs give the same bytes for any number of threads.
Clusters cluster_texels(LayerMoments layers, int size, std::span<const std::uint32_t> centres,
                        const KmeansParams& params, gpu::Device& device, Report& report);

// Centres: texels under params.count points that are distributed as the density, in the order of the points
// (rule and scale play no part). Points where nothing reflects are left out. In 2D each layer with weight has
// a centre: where no point fell into it, its brightest texel, instead of the last centre of the layer that
// has most if there are `count` already. So has in 3D the whole of all layers. Empty where nothing reflects.
// Throws out_of_range where `count` is less than such layers.
std::vector<std::uint32_t> choose_centres(std::span<const DensityPyramid> densities, LayerMoments layers,
                                          std::uint32_t space, KernelParams params, gpu::Device& device,
                                          Report& report);

}  // namespace vsgl
