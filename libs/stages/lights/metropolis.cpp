#include <algorithm>

#include "base/error.h"
#include "pyramid/kernels.h"
#include "stages/lights/filtered.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

constexpr std::uint32_t burn_in = 64;  // mutations of new chains

void check_chains(const Chains& chains, const Rsm& rsm, const LightsParams& params) {
  if (chains.states.size() != static_cast<std::size_t>(params.count))
    throw Error(ErrorCode::wrong_size, "previous: " + std::to_string(chains.states.size()) +
                                           " chains for a count of " + std::to_string(params.count) +
                                           "; keep the count, or begin anew without the frame before");
  const bool fit = std::all_of(chains.states.begin(), chains.states.end(),
                               [&](const interop::Chain& chain) { return chain.layer < rsm.layers.size(); });
  if (!fit)
    throw Error(ErrorCode::invalid_data, "previous: a chain is in a layer that the RSM of " +
                                             std::to_string(rsm.layers.size()) +
                                             " layers lacks; begin anew without the frame before");
}

// New chains burn in, the others go on from where the frame before left them.
WalkParams walk_params(const Rsm& rsm, const LightsParams& params) {
  WalkParams walk;
  walk.large_step = params.large_step;
  walk.mutations = burn_in;
  if (!params.previous) return walk;
  check_chains(*params.previous, rsm, params);
  walk.start = params.previous->states;
  walk.first_step = static_cast<std::uint32_t>(params.previous->steps);
  walk.mutations = static_cast<std::uint32_t>(params.mutations);
  return walk;
}

}  // namespace

// [Barak 2013, as cited in Tokuyoshi 2016, Fig. 8] temporally coherent sampling: the kernels' centres are
// Markov chains over the RSM's texels that go on from frame to frame. Kernels and powers are those of
// fis-2016.
LightSet generate_metropolis(const Rsm& rsm, const Pdf* pdf, const LightsParams& params, gpu::Device* device,
                             Report& report) {
  const WalkParams walk = walk_params(rsm, params);
  const Walk walked =
      walk_chains(densities_of(*pdf), kernel_params(params, share_rule(params)), walk, *device, report);
  if (walk.mutations > 0)
    report.count("acceptance_rate",
                 static_cast<double>(walked.accepted) / (static_cast<double>(walk.mutations) * params.count));
  report.count("chains_without_density",
               std::count_if(walked.kernels.begin(), walked.kernels.end(),
                             [](const interop::Kernel& kernel) { return kernel.power_scale <= 0; }));
  LightSet set;
  set.lights = filter_lights(rsm, walked.kernels, params, *device, report);
  conserve_power(rsm, params, set.lights, report);
  set.chains = {walked.chains, static_cast<int>(walk.first_step + walk.mutations)};
  return set;
}

}  // namespace vsgl
