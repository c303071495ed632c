#include "pyramid/kernels.h"

#include <algorithm>

#include "gpu/address.h"
#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "spirv/pyramid/draw.comp.glsl.h"
#include "spirv/pyramid/filter.comp.glsl.h"

namespace vsgl {
namespace {

using gpu::Buffer;
using interop::Kernel;
using interop::Light;
using interop::Moments;

constexpr std::uint32_t group_size = 64;

struct DrawPush {
  interop::uvec2 densities_at, kernels_at;
  interop::PointSet points;
  std::uint32_t rule, layers;
  std::int32_t top;
  float scale;
};

struct FilterPush {
  interop::uvec2 kernels_at, moments_at, lights_at;
  std::uint32_t count, layer;
  std::int32_t top;
  float variance_floor;
};

Buffer upload_densities(std::span<const DensityPyramid> layers, gpu::Device& device) {
  const std::size_t bytes = layers.front().texels.size_bytes();
  Buffer buffer(device, bytes * layers.size());
  for (std::size_t k = 0; k < layers.size(); ++k) buffer.write(k * bytes, std::as_bytes(layers[k].texels));
  return buffer;
}

// Filters the kernels of a chunk that lie in the layer of `pyramid`; `lights` keeps those of other layers.
void filter_layer(const gpu::ComputePipeline& pipeline, FilterPush push, std::span<const Moments> pyramid,
                  gpu::Device& device, Report& report) {
  const Buffer moments = Buffer::from(device, pyramid);
  push.moments_at = address_of(moments);
  gpu::Commands commands(device);
  commands.dispatch("filter", pipeline, {}, push, {gpu::groups_for(push.count, group_size), 1, 1});
  commands.submit(report);
}

}  // namespace

std::vector<Kernel> draw_kernels(std::span<const DensityPyramid> layers, const KernelParams& params,
                                 gpu::Device& device, Report& report) {
  PhaseTimer timer(report, "draw");
  const Buffer densities = upload_densities(layers, device);
  Buffer kernels(device, params.count * sizeof(Kernel));
  const DrawPush push{address_of(densities),
                      address_of(kernels),
                      make_point_set(params.points, params.count, params.seed),
                      params.rule,
                      static_cast<std::uint32_t>(layers.size()),
                      layers.front().top(),
                      static_cast<float>(params.scale)};
  const gpu::ComputePipeline pipeline(device, draw_comp_spv, {}, sizeof push);
  gpu::Commands commands(device);
  commands.dispatch("draw", pipeline, {}, push, {gpu::groups_for(params.count, group_size), 1, 1});
  commands.submit(report);
  return kernels.download<Kernel>(params.count);
}

std::vector<Light> filter_moments(std::span<const Kernel> kernels,
                                  std::span<const std::span<const Moments>> layers, int size,
                                  double variance_floor, gpu::Device& device, Report& report) {
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
                          address_of(lights),
                          static_cast<std::uint32_t>(kernels.size()),
                          layer,
                          pyramid_levels(size) - 1,
                          static_cast<float>(variance_floor)};
    filter_layer(pipeline, push, layers[layer], device, report);
  }
  return lights.download<Light>(kernels.size());
}

}  // namespace vsgl
