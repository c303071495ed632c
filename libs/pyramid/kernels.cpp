#include "pyramid/kernels.h"

#include <algorithm>

#include "gpu/address.h"
#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "interop/kernel_setup.h"
#include "pyramid/moment_pyramid.h"
#include "spirv/pyramid/draw.comp.glsl.h"
#include "spirv/pyramid/filter.comp.glsl.h"
#include "spirv/pyramid/metropolis.comp.glsl.h"

namespace vsgl {
namespace {

using gpu::Buffer;
using interop::Kernel;
using interop::Light;
using interop::Moments;

constexpr std::uint32_t group_size = 64;

struct DrawPush {
  interop::KernelSetup setup;
  interop::uvec2 kernels_at;
};

struct MetropolisPush {
  interop::KernelSetup setup;
  interop::uvec2 chains_at, kernels_at, accepted_at;
  std::uint32_t is_new, first_step, mutations;
  float large_step;
};

struct FilterPush {
  interop::uvec2 kernels_at, finest_at, coarser_at, lights_at;
  std::uint32_t count, layer;
  std::int32_t top;
  float variance_floor;
  std::uint32_t lobe_filter;
};

Buffer upload_densities(std::span<const DensityPyramid> layers, gpu::Device& device) {
  const std::size_t bytes = layers.front().texels.size_bytes();
  Buffer buffer(device, bytes * layers.size());
  for (std::size_t k = 0; k < layers.size(); ++k) buffer.write(k * bytes, std::as_bytes(layers[k].texels));
  return buffer;
}

interop::KernelSetup make_setup(const Buffer& densities, std::span<const DensityPyramid> layers,
                                const KernelParams& params) {
  return {address_of(densities),
          make_point_set(params.points, params.count, params.seed),
          params.rule,
          static_cast<std::uint32_t>(layers.size()),
          static_cast<std::uint32_t>(layers.front().top()),
          static_cast<float>(params.scale)};
}

// Filters the kernels that lie in the layer of `pyramid`; `lights` keeps those of other layers. The finest
// level has a buffer of its own: at 4096 texels a side all levels together would be more than devices
// allocate at once.
void filter_layer(const gpu::ComputePipeline& pipeline, FilterPush push, std::span<const Moments> pyramid,
                  gpu::Device& device, Report& report) {
  const int size = 1 << push.top;
  const std::size_t texels = pyramid_offset(size, 1);
  const Buffer finest = Buffer::from(device, pyramid.first(texels)),
               coarser = Buffer::from(device, pyramid.subspan(texels));
  push.finest_at = address_of(finest);
  push.coarser_at = address_of(coarser);
  gpu::Commands commands(device);
  if (needs_encoding(push.lobe_filter)) {
    encode_lobes(finest, texels, push.lobe_filter, device, commands);
    merge_levels(finest, coarser, size, device, commands);
  }
  commands.dispatch("filter", pipeline, {}, push, {gpu::groups_for(push.count, group_size), 1, 1});
  commands.submit(report);
}

}  // namespace

std::vector<Kernel> draw_kernels(std::span<const DensityPyramid> layers, const KernelParams& params,
                                 gpu::Device& device, Report& report) {
  PhaseTimer timer(report, "draw");
  const Buffer densities = upload_densities(layers, device);
  Buffer kernels(device, params.count * sizeof(Kernel));
  const DrawPush push{make_setup(densities, layers, params), address_of(kernels)};
  const gpu::ComputePipeline pipeline(device, draw_comp_spv, {}, sizeof push);
  gpu::Commands commands(device);
  commands.dispatch("draw", pipeline, {}, push, {gpu::groups_for(params.count, group_size), 1, 1});
  commands.submit(report);
  return kernels.download<Kernel>(params.count);
}

Walk walk_chains(std::span<const DensityPyramid> layers, const KernelParams& params, const WalkParams& walk,
                 gpu::Device& device, Report& report) {
  PhaseTimer timer(report, "walk");
  const Buffer densities = upload_densities(layers, device);
  const bool is_new = walk.start.empty();
  Buffer chains =
      is_new ? Buffer(device, params.count * sizeof(interop::Chain)) : Buffer::from(device, walk.start);
  Buffer kernels(device, params.count * sizeof(Kernel)),
      accepted(device, params.count * sizeof(std::uint32_t));
  const MetropolisPush push{make_setup(densities, layers, params),
                            address_of(chains),
                            address_of(kernels),
                            address_of(accepted),
                            is_new ? 1u : 0u,
                            walk.first_step,
                            walk.mutations,
                            static_cast<float>(walk.large_step)};
  const gpu::ComputePipeline pipeline(device, metropolis_comp_spv, {}, sizeof push);
  gpu::Commands commands(device);
  commands.dispatch("walk", pipeline, {}, push, {gpu::groups_for(params.count, group_size), 1, 1});
  commands.submit(report);
  Walk out{kernels.download<Kernel>(params.count), chains.download<interop::Chain>(params.count), 0};
  for (const std::uint32_t count : accepted.download<std::uint32_t>(params.count)) out.accepted += count;
  return out;
}

std::vector<Light> filter_moments(std::span<const Kernel> kernels,
                                  std::span<const std::span<const Moments>> layers, int size,
                                  double variance_floor, gpu::Device& device, Report& report,
                                  std::uint32_t lobe_filter) {
  PhaseTimer timer(report, "filter");
  const gpu::ComputePipeline pipeline(device, filter_comp_spv, {}, sizeof(FilterPush));
  const Buffer kernel_buffer = Buffer::from(device, kernels);
  Buffer lights(device, kernels.size() * sizeof(Light));
  lights.clear();
  for (std::uint32_t layer = 0; layer < layers.size(); ++layer) {
    if (std::none_of(kernels.begin(), kernels.end(), [layer](const Kernel& k) { return k.layer == layer; }))
      continue;
    const FilterPush push{address_of(kernel_buffer),
                          {},
                          {},
                          address_of(lights),
                          static_cast<std::uint32_t>(kernels.size()),
                          layer,
                          pyramid_levels(size) - 1,
                          static_cast<float>(variance_floor),
                          lobe_filter};
    filter_layer(pipeline, push, layers[layer], device, report);
  }
  return lights.download<Light>(kernels.size());
}

}  // namespace vsgl
