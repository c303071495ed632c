#include "stages/shading/cut_pass.h"

#include <algorithm>
#include <cstdint>

#include "interop/shading.h"
#include "spirv/shading/cut.comp.glsl.h"  // after <cstdint>, which it needs

namespace vsgl {
namespace {

constexpr const char* kPhase = "shade";

// Invocations that share a block: a vector of lavapipe's, a warp elsewhere.
std::uint32_t lanes_of(const gpu::Device& device) {
  return std::clamp(device.info().subgroup_size, 8u, 32u);
}

std::vector<interop::Surface> gather_surfaces(const GBuffer& gbuffer, std::span<const std::uint32_t> pixels) {
  std::vector<interop::Surface> out(pixels.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < pixels.size(); ++i) out[i] = gbuffer.pixels[pixels[i]];
  return out;
}

}  // namespace

CutPass::CutPass(const GBuffer& gbuffer, const Cut& cut, const CutClusters& clusters, bool skip,
                 gpu::Device& device)
    : gbuffer_(gbuffer),
      cut_(cut),
      clusters_(clusters),
      skip_(skip),
      device_(device),
      cluster_buffer_(gpu::Buffer::from(device, clusters.clusters)) {}

// How many blocks from `first` on fit at once.
std::size_t CutPass::leading(const CutReceivers& receivers, std::size_t first, std::size_t words) const {
  const VkPhysicalDeviceLimits& limits = device_.limits();
  const std::size_t item = cut_.has_visibility() ? interop::CUT_MASKED_ITEM : interop::CUT_ITEM,
                    most_words = std::min<std::size_t>(words, item * limits.maxTexelBufferElements),
                    most_blocks = std::min<std::size_t>(
                        limits.maxComputeWorkGroupCount[0],
                        limits.maxStorageBufferRange / (interop::CUT_BLOCK * sizeof(interop::Surface)));
  std::size_t count = 0, total = 0;
  while (first + count < receivers.blocks.size() && count < most_blocks) {
    total += item * cut_.tiles[receivers.blocks[first + count].tile].count;
    if (count > 0 && total > most_words) break;
    ++count;
  }
  return count;
}

gpu::ComputePipeline CutPass::pipeline_of(const CutKernel& kernel) const {
  using gpu::Binding;
  const std::uint32_t lanes = lanes_of(device_);
  return gpu::ComputePipeline(
      device_, cut_comp_spv,
      {Binding::storage, Binding::storage, Binding::texel_rgba32f,
       cut_.has_visibility() ? Binding::texel_rgba32ui : Binding::texel_r32ui, Binding::storage},
      sizeof(interop::CutPush),
      {{interop::SHADING_RECEIVER_ID, kernel.ndf},
       {interop::SHADING_EMISSION_ID, skip_ ? clusters_.ndf : interop::NDF_ANY},
       {interop::SHADING_BUMPED_ID, kernel.bumped},
       {interop::SHADING_PIXELS_ID, (kernel.wide ? interop::CUT_BLOCK : kNarrowBlock) / lanes},
       {interop::CUT_LANES_ID, lanes},
       {interop::CUT_MASKED_ID, cut_.has_visibility()}});
}

void CutPass::prepare(const CutKernel& kernel) {
  building_.push_back(std::async(std::launch::async, [this, kernel] { pipeline_of(kernel); }));
}

std::vector<interop::CutSums> CutPass::run(const CutReceivers& receivers, std::size_t words, Report& report) {
  const gpu::ComputePipeline pipeline = pipeline_of(receivers);
  const interop::CutPush push{{static_cast<float>(gbuffer_.camera.x), static_cast<float>(gbuffer_.camera.y),
                               static_cast<float>(gbuffer_.camera.z)}};
  std::vector<interop::CutSums> sums;
  for (std::size_t first = 0; first < receivers.blocks.size();) {
    const std::size_t count = leading(receivers, first, words);
    const std::span blocks = std::span(receivers.blocks).subspan(first, count);
    const CutLists lists = build_lists(gbuffer_, cut_, clusters_, receivers, blocks, skip_, counts_);
    const std::size_t pixels = blocks.back().first + blocks.back().count - blocks.front().first;
    gpu::Buffer surfaces = gpu::Buffer::from(
        device_,
        gather_surfaces(gbuffer_, std::span(receivers.pixels).subspan(blocks.front().first, pixels)));
    gpu::Buffer block_buffer = gpu::Buffer::from(device_, lists.blocks);
    gpu::Buffer items = gpu::Buffer::from(device_, lists.items);
    gpu::Buffer results(device_, pixels * sizeof(interop::CutSums));
    gpu::Commands commands(device_);
    commands.dispatch(kPhase, pipeline, {surfaces, block_buffer, cluster_buffer_, items, results}, push,
                      {static_cast<std::uint32_t>(count), 1, 1});
    commands.submit(report);
    const std::vector<interop::CutSums> part = results.download<interop::CutSums>(pixels);
    sums.insert(sums.end(), part.begin(), part.end());
    first += count;
  }
  return sums;
}

}  // namespace vsgl
