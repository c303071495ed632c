#include <algorithm>

#include "base/error.h"
#include "kmeans/kmeans.h"

namespace vsgl {
namespace {

// The texels that may share a cluster: a layer's in 2D, all in 3D.
struct Group {
  std::uint32_t begin, end;
  std::size_t centres;
};

// The centres as they are being chosen.
struct Choice {
  std::vector<std::uint32_t> centres;
  std::vector<Group> groups;
  std::size_t limit;

  Group& group_of(std::uint32_t texel) {
    return *std::ranges::find_if(groups, [texel](const Group& g) { return texel < g.end; });
  }
  void add(std::uint32_t texel) {
    centres.push_back(texel);
    ++group_of(texel).centres;
  }
  // Makes room for another centre.
  void drop_last_of_largest();
};

void Choice::drop_last_of_largest() {
  Group& largest = *std::ranges::max_element(groups, {}, &Group::centres);
  if (largest.centres < 2)
    throw Error(
        ErrorCode::out_of_range,
        "count: " + std::to_string(limit) +
            " is less than the RSM has layers that reflect, which method kmeans-2d keeps apart; raise it");
  const auto last = std::ranges::find_if(centres.rbegin(), centres.rend(), [&](std::uint32_t texel) {
    return texel >= largest.begin && texel < largest.end;
  });
  centres.erase(std::next(last).base());
  --largest.centres;
}

}  // namespace

std::vector<std::uint32_t> choose_centres(std::span<const DensityPyramid> densities, LayerMoments layers,
                                          std::uint32_t space, KernelParams params, gpu::Device& device,
                                          Report& report) {
  const auto size = static_cast<std::uint32_t>(densities.front().size), texels = size * size;
  const auto weight = [&](std::uint32_t texel) { return layers[texel / texels][texel % texels].weight; };
  Choice choice{{}, {}, params.count};
  const auto all = static_cast<std::uint32_t>(layers.size()) * texels;
  const std::uint32_t step = space == interop::KMEANS_2D ? texels : all;
  for (std::uint32_t begin = 0; begin < all; begin += step) choice.groups.push_back({begin, begin + step, 0});
  params.rule = interop::KERNEL_TEXEL;
  for (const interop::Kernel& kernel : draw_kernels(densities, params, device, report)) {
    const std::uint32_t texel = kernel.layer * texels + kernel.texel;
    if (weight(texel) > 0) choice.add(texel);
  }
  for (const Group& group : choice.groups) {
    if (group.centres > 0) continue;
    std::uint32_t brightest = group.begin;
    for (std::uint32_t texel = group.begin; texel < group.end; ++texel)
      if (weight(texel) > weight(brightest)) brightest = texel;
    if (!(weight(brightest) > 0)) continue;
    if (choice.centres.size() == choice.limit) choice.drop_last_of_largest();
    choice.add(brightest);
  }
  return choice.centres;
}

}  // namespace vsgl
