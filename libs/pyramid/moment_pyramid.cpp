#include "pyramid/moment_pyramid.h"

#include <span>

#include "gpu/address.h"
#include "math/pyramid.h"
#include "spirv/pyramid/merge.comp.glsl.h"

namespace vsgl {
namespace {

constexpr std::uint32_t group_side = 8;

std::size_t texels(int side) {
  return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}

}  // namespace

MomentPyramid::MomentPyramid(gpu::Device& device, int size)
    : size_(size), pipeline_(device, merge_comp_spv, {}, sizeof(interop::MergePush)) {
  for (int level = 0; level < pyramid_levels(size); ++level)
    levels_.emplace_back(device, texels(size >> level) * sizeof(interop::Moments));
}

void MomentPyramid::merge(gpu::Commands& commands) const {
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const auto side = static_cast<std::uint32_t>(size_ >> level), groups = gpu::groups_for(side, group_side);
    const interop::MergePush push{address_of(levels_[level - 1]), address_of(levels_[level]), side};
    commands.dispatch("pyramid", pipeline_, {}, push, {groups, groups, 1});
  }
}

std::vector<interop::Moments> MomentPyramid::download() {
  std::vector<interop::Moments> pyramid(pyramid_texels(size_));
  const std::span<interop::Moments> all(pyramid);
  for (int level = 0; level < pyramid_levels(size_); ++level)
    levels_[static_cast<std::size_t>(level)].read(
        0, std::as_writable_bytes(all.subspan(pyramid_offset(size_, level), texels(size_ >> level))));
  return pyramid;
}

}  // namespace vsgl
