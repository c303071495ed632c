#include "pyramid/moment_pyramid.h"

#include <algorithm>
#include <span>

#include "gpu/address.h"
#include "interop/lobe_filter.h"
#include "math/pyramid.h"
#include "spirv/pyramid/encode_lobes.comp.glsl.h"
#include "spirv/pyramid/merge.comp.glsl.h"

namespace vsgl {
namespace {

constexpr std::uint32_t group_side = 8, encode_group = 64;
constexpr std::uint32_t encode_row = 32768;  // groups along x: devices need not take more than 65535

struct EncodePush {
  interop::uvec2 texels_at;
  std::uint32_t count, lobe_filter;
};

std::size_t texels(int side) {
  return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}

// `size`: texels a side of the coarser level.
void merge_step(const gpu::ComputePipeline& pipeline, interop::uvec2 fine_at, interop::uvec2 coarse_at,
                int size, gpu::Commands& commands) {
  const interop::MergePush push{fine_at, coarse_at, static_cast<std::uint32_t>(size)};
  const std::uint32_t groups = gpu::groups_for(push.size, group_side);
  commands.dispatch("pyramid", pipeline, {}, push, {groups, groups, 1});
}

}  // namespace

MomentPyramid::MomentPyramid(gpu::Device& device, int size)
    : size_(size), pipeline_(device, merge_comp_spv, {}, sizeof(interop::MergePush)) {
  for (int level = 0; level < pyramid_levels(size); ++level)
    levels_.emplace_back(device, texels(size >> level) * sizeof(interop::Moments));
}

void MomentPyramid::merge(gpu::Commands& commands) const {
  for (std::size_t level = 1; level < levels_.size(); ++level)
    merge_step(pipeline_, address_of(levels_[level - 1]), address_of(levels_[level]), size_ >> level,
               commands);
}

std::vector<interop::Moments> MomentPyramid::download() {
  std::vector<interop::Moments> pyramid(pyramid_texels(size_));
  const std::span<interop::Moments> all(pyramid);
  for (int level = 0; level < pyramid_levels(size_); ++level)
    levels_[static_cast<std::size_t>(level)].read(
        0, std::as_writable_bytes(all.subspan(pyramid_offset(size_, level), texels(size_ >> level))));
  return pyramid;
}

bool needs_encoding(std::uint32_t lobe_filter) {
  return lobe_filter == interop::LOBE_TOKSVIG || lobe_filter == interop::LOBE_LAURIJSSEN;
}

void encode_lobes(const gpu::Buffer& moments, std::size_t texels, std::uint32_t lobe_filter,
                  gpu::Device& device, gpu::Commands& commands) {
  const EncodePush push{address_of(moments), static_cast<std::uint32_t>(texels), lobe_filter};
  const gpu::ComputePipeline pipeline(device, encode_lobes_comp_spv, {}, sizeof push);
  const std::uint32_t groups = gpu::groups_for(push.count, encode_group),
                      rows = gpu::groups_for(groups, encode_row);
  commands.dispatch("lobes", pipeline, {}, push, {std::min(groups, encode_row), rows, 1});
}

void merge_levels(const gpu::Buffer& finest, const gpu::Buffer& coarser, int size, gpu::Device& device,
                  gpu::Commands& commands) {
  const gpu::ComputePipeline pipeline(device, merge_comp_spv, {}, sizeof(interop::MergePush));
  const auto level_at = [&](int level) {
    return level == 0 ? address_of(finest)
                      : address_of(coarser, pyramid_offset(size / 2, level - 1) * sizeof(interop::Moments));
  };
  for (int level = 1; level < pyramid_levels(size); ++level)
    merge_step(pipeline, level_at(level - 1), level_at(level), size >> level, commands);
}

}  // namespace vsgl
