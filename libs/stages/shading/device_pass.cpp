#include "stages/shading/device_pass.h"

#include <algorithm>
#include <array>

#include "math/interop_vec.h"

namespace vsgl {
namespace {

using interop::ShadingSums;

constexpr const char* kPhase = "shade";

// The more, the fewer loads of lights, but the longer the compilation of the unrolled loop.
std::uint32_t pixels_per_invocation(std::uint32_t receiver, std::uint32_t emission) {
  if (receiver == interop::NDF_ANY) return 1;
  return receiver == interop::NDF_NONE && emission == interop::NDF_NONE ? 8 : 4;
}

}  // namespace

std::vector<LightList> sort_lights(const PackedLights& lights, bool skip) {
  std::array<LightList, interop::NDF_ANY + 1> lists;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const std::uint32_t ndf = skip ? lights.ndf(i) : interop::NDF_ANY;
    lists[ndf].ndf = ndf;
    lists[ndf].lights.push_back(i);
  }
  std::vector<LightList> out;
  for (LightList& list : lists)
    if (!list.lights.empty()) out.push_back(std::move(list));
  return out;
}

DevicePass::DevicePass(const GBuffer& gbuffer, const Visibility* visibility, const ShadingKernel& kernel,
                       gpu::Device& device)
    : kernel_(kernel), device_(device), visibility_(visibility, device) {
  push_.camera = to_float(gbuffer.camera);
  push_.cancel_scale = kernel.threshold > 0 ? 2 / kernel.threshold : 0;
  push_.clamp_distance2 = kernel.clamp_distance2;
  push_.vsl = kernel.vsl;
  visibility_.describe(push_);
}

std::vector<ShadingSums> DevicePass::run(const ReceiverList& receivers, const std::vector<LightList>& lights,
                                         Report& report) {
  const std::size_t count = receivers.pixels.size(), most = kernel_.receivers > 0 ? kernel_.receivers : count;
  std::vector<ShadingSums> sums;
  for (std::size_t first = 0; first < count; first += most) {
    const auto part = run_part(slice(receivers, first, std::min(most, count - first)), lights, report);
    sums.insert(sums.end(), part.begin(), part.end());
  }
  return sums;
}

std::vector<ShadingSums> DevicePass::run_part(const ReceiverList& receivers,
                                              const std::vector<LightList>& lights, Report& report) {
  gpu::Buffer surfaces = gpu::Buffer::from(device_, receivers.surfaces);
  gpu::Buffer results(device_, receivers.surfaces.size() * sizeof(ShadingSums));
  results.clear();
  for (const LightList& list : lights) {
    const std::uint32_t pixels =
        kernel_.pixels > 0 ? kernel_.pixels : pixels_per_invocation(receivers.ndf, list.ndf);
    const gpu::ComputePipeline pipeline = build(receivers, list.ndf, pixels);
    std::span<const std::uint32_t> rest = list.lights;
    while (!rest.empty()) {
      const auto block =
          visibility_.leading(rest.first(std::min(block_lights(), rest.size())), receivers.pixels.size());
      dispatch(pipeline, surfaces, block, receivers, results, pixels, report);
      rest = rest.subspan(block.size());
    }
  }
  return results.download<ShadingSums>(receivers.surfaces.size());
}

std::size_t DevicePass::block_lights() const {
  return std::min<std::size_t>(interop::SHADING_BLOCK_LIGHTS,
                               device_.limits().maxUniformBufferRange / kernel_.lights.stride());
}

// The whole block is bound, so that the shader's array is backed even where it is not read.
gpu::Buffer DevicePass::upload_block(std::span<const std::uint32_t> lights) const {
  const std::size_t stride = kernel_.lights.stride();
  std::vector<std::byte> block(block_lights() * stride);
  for (std::size_t i = 0; i < lights.size(); ++i)
    std::ranges::copy(kernel_.lights.record(lights[i]),
                      block.begin() + static_cast<std::ptrdiff_t>(i * stride));
  return gpu::Buffer::from(device_, block);
}

gpu::ComputePipeline DevicePass::build(const ReceiverList& receivers, std::uint32_t emission,
                                       std::uint32_t pixels) const {
  using gpu::Binding;
  return gpu::ComputePipeline(device_, kernel_.spirv,
                              {Binding::storage, Binding::uniform, Binding::storage, Binding::storage,
                               Binding::storage, Binding::storage},
                              sizeof(push_),
                              {{interop::SHADING_RECEIVER_ID, receivers.ndf},
                               {interop::SHADING_EMISSION_ID, emission},
                               {interop::SHADING_SHADOWS_ID, visibility_.kind()},
                               {interop::SHADING_CANCEL_ID, kernel_.threshold > 0},
                               {interop::SHADING_BUMPED_ID, receivers.bumped},
                               {interop::SHADING_LOBE_ID, kernel_.lobe},
                               {interop::SHADING_PIXELS_ID, pixels}});
}

void DevicePass::dispatch(const gpu::ComputePipeline& pipeline, gpu::Buffer& surfaces,
                          std::span<const std::uint32_t> lights, const ReceiverList& receivers,
                          gpu::Buffer& results, std::uint32_t pixels, Report& report) {
  const std::size_t count = receivers.pixels.size();
  push_.receivers = static_cast<std::uint32_t>(count);
  push_.lights = static_cast<std::uint32_t>(lights.size());
  visibility_.locate(lights, push_);
  gpu::Buffer block = upload_block(lights);
  gpu::Buffer bits = visibility_.bits(lights, receivers.pixels);
  gpu::Commands commands(device_);
  commands.dispatch(kPhase, pipeline,
                    {surfaces, block, results, visibility_.maps(lights), visibility_.views(), bits}, push_,
                    {gpu::groups_for(count, interop::SHADING_GROUP * pixels), 1, 1});
  commands.submit(report);
}

}  // namespace vsgl
