#pragma once

// Filtered importance sampling on the device: kernels drawn from a density pyramid, and moments filtered over
// them. docs/sampling.md derives what is computed.

#include <cstdint>
#include <span>
#include <vector>

#include "base/report.h"
#include "gpu/device.h"
#include "interop/chain.h"
#include "interop/light.h"
#include "interop/lobe_filter.h"
#include "interop/moments.h"
#include "interop/sampling.h"
#include "math/sampling.h"

namespace vsgl {

struct KernelParams {
  std::uint32_t count = 1024;  // N, 1..MAX_POINTS
  std::uint32_t points = interop::POINTS_LATTICE;
  std::uint32_t rule = interop::KERNEL_NEWTON;
  double scale = 1;  // K > 0: share of the samples that a kernel holds, times N
  std::uint64_t seed = 0;
};

// N kernels whose centres are distributed as the density, in the order of the points. `layers`: mean pyramids
// of equal size, of mean 1 over all layers together. Kernels never cross from one layer into another.
std::vector<interop::Kernel> draw_kernels(std::span<const DensityPyramid> layers, const KernelParams& params,
                                          gpu::Device& device, Report& report);

struct WalkParams {
  // `count` chains, of layers that there are; none: new ones, at the points.
  std::span<const interop::Chain> start = {};
  std::uint32_t first_step = 0;  // mutations that the chains have had
  std::uint32_t mutations = 1;   // of each chain
  double large_step = 1;         // probability that a mutation goes anywhere, 0..1
};

// Chains with the kernels about them, in their order. A kernel where the density is 0 has a power_scale of 0.
struct Walk {
  std::vector<interop::Kernel> kernels;
  std::vector<interop::Chain> chains;
  std::uint64_t accepted = 0;  // mutations, of all chains
};

// [Barak 2013] N Markov chains over the texels of all layers, moved by Metropolis mutations that leave the
// density stationary (shaders/lib/metropolis.glsl); kernels as of draw_kernels(). The random numbers depend
// on the seed, the chain and the number of the mutation alone.
Walk walk_chains(std::span<const DensityPyramid> layers, const KernelParams& params, const WalkParams& walk,
                 gpu::Device& device, Report& report);

// Lights from the moments under kernels, one a kernel, in their order: position, variance (at least
// `variance_floor`, m^2), powers, lobes, mean normal (zero where there is none) and its deficit, level,
// texel, layer; the other members are 0. `layers`: moment pyramids (math/pyramid.h) of size x size texels,
// one per layer that the kernels were drawn from. `lobe_filter`: LOBE_*.
std::vector<interop::Light> filter_moments(std::span<const interop::Kernel> kernels,
                                           std::span<const std::span<const interop::Moments>> layers,
                                           int size, double variance_floor, gpu::Device& device,
                                           Report& report,
                                           std::uint32_t lobe_filter = interop::LOBE_BANERJEE);

}  // namespace vsgl
