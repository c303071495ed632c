#include "pyramid/kernels.h"

#include <algorithm>

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "spirv/pyramid/draw.comp.glsl.h"
#include "spirv/pyramid/filter.comp.glsl.h"

namespace vsgl {
namespace {

using gpu::Binding;
using gpu::Buffer;
using interop::Kernel;
using interop::Light;
using interop::Moments;

constexpr std::uint32_t group_size = 64;
constexpr std::size_t chunk = 262144;  // lights filtered at a time: 36 MiB

struct DrawPush {
  interop::PointSet points;
  std::uint32_t rule, layers;
  std::int32_t top;
  float scale;
};

struct FilterPush {
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

// Filters all kernels of a chunk that lie in `layer`; `lights` keeps those of other layers.
void filter_layer(const gpu::ComputePipeline& pipeline, std::span<const Kernel> kernels,
                  std::span<const Moments> pyramid, const FilterPush& push, gpu::Device& device,
                  Report& report, Buffer& lights) {
  const std::size_t finest_texels = std::size_t{1} << (2 * push.top);
  Buffer kernel_buffer = Buffer::from(device, kernels);
  Buffer finest = Buffer::from(device, pyramid.first(finest_texels));
  Buffer coarser = Buffer::from(device, pyramid.subspan(finest_texels));
  gpu::Commands commands(device);
  commands.dispatch("filter", pipeline, {kernel_buffer, finest, coarser, lights}, push,
                    {gpu::groups_for(kernels.size(), group_size), 1, 1});
  commands.submit(report);
}

}  // namespace

std::vector<Kernel> draw_kernels(std::span<const DensityPyramid> layers, const KernelParams& params,
                                 gpu::Device& device, Report& report) {
  PhaseTimer timer(report, "draw");
  DrawPush push{make_point_set(params.points, params.count, params.seed), params.rule,
                static_cast<std::uint32_t>(layers.size()), layers.front().top(),
                static_cast<float>(params.scale)};
  Buffer densities = upload_densities(layers, device);
  Buffer kernels(device, params.count * sizeof(Kernel));
  const gpu::ComputePipeline pipeline(device, draw_comp_spv, {Binding::storage, Binding::storage},
                                      sizeof push);
  gpu::Commands commands(device);
  commands.dispatch("draw", pipeline, {densities, kernels}, push,
                    {gpu::groups_for(params.count, group_size), 1, 1});
  commands.submit(report);
  return kernels.download<Kernel>(params.count);
}

std::vector<Light> filter_moments(std::span<const Kernel> kernels,
                                  std::span<const std::span<const Moments>> layers, int size,
                                  double variance_floor, gpu::Device& device, Report& report) {
  PhaseTimer timer(report, "filter");
  const gpu::ComputePipeline pipeline(
      device, filter_comp_spv, {Binding::storage, Binding::storage, Binding::storage, Binding::storage},
      sizeof(FilterPush));
  std::vector<Light> lights;
  lights.reserve(kernels.size());
  for (std::size_t first = 0; first < kernels.size(); first += chunk) {
    const auto part = kernels.subspan(first, std::min(chunk, kernels.size() - first));
    Buffer filtered(device, part.size() * sizeof(Light));
    filtered.clear();
    for (std::uint32_t layer = 0; layer < layers.size(); ++layer) {
      if (std::none_of(part.begin(), part.end(), [layer](const Kernel& k) { return k.layer == layer; }))
        continue;
      const FilterPush push{static_cast<std::uint32_t>(part.size()), layer, pyramid_levels(size) - 1,
                            static_cast<float>(variance_floor)};
      filter_layer(pipeline, part, layers[layer], push, device, report, filtered);
    }
    const auto done = filtered.download<Light>(part.size());
    lights.insert(lights.end(), done.begin(), done.end());
  }
  return lights;
}

}  // namespace vsgl
