#include <limits>

#include "base/error.h"
#include "stages/lights/methods.h"
#include "stages/lights/tree_lights.h"

namespace vsgl {
namespace {

// One level of a tree as a list: its nodes, and the leaves above it, so that no power is missing.
LightSet level_of(const LightSet& tree, int level) {
  const auto deepest = static_cast<int>(tree.levels.size()) - 2;
  if (level > deepest)
    throw Error(ErrorCode::out_of_range, "level: " + std::to_string(level) + " is beyond the tree's 0.." +
                                             std::to_string(deepest) + "; choose one of these");
  LightSet list;
  for (const std::uint32_t node : level_nodes(tree.lights, tree.levels, static_cast<std::size_t>(level))) {
    list.lights.push_back(tree.lights[node]);
    list.lights.back().children = 0;
  }
  return list;
}

std::vector<LitTexel> collect(const Rsm& rsm, Report& report) {
  std::vector<LitTexel> texels = lit_texels(rsm);
  report.count("lit_texels", texels.size());
  report.count("unlit_texels", rsm.texel_count() - texels.size());
  if (texels.size() > std::numeric_limits<int>::max() / 2)
    throw Error(ErrorCode::out_of_range,
                "method tree: " + std::to_string(texels.size()) +
                    " texels reflect, more than a tree can hold; bake a smaller RSM");
  if (texels.empty()) report.skipped("tree", "no texel reflects: nothing emits");
  return texels;
}

}  // namespace

// A k-d tree over all texels that reflect: its leaves are the texels, its inner nodes clusters of them.
LightSet generate_tree(const Rsm& rsm, const Pdf*, const LightsParams& params, gpu::Device*, Report& report) {
  report.skipped("sampling",
                 "method tree clusters every texel that reflects: density, count, points and kernels play no "
                 "part");
  std::vector<LitTexel> texels = collect(rsm, report);
  TexelTree split;
  {
    const PhaseTimer timer(report, "split");
    split = split_texels(std::move(texels));
  }
  const PhaseTimer timer(report, "merge");
  LightSet tree{tree_lights(rsm, split), std::move(split.levels)};
  if (!tree.lights.empty() && tree.lights.front().ndf == interop::NDF_NONE)
    report.skipped("specular emission", "no texel has specular power");
  if (params.level < 0 || tree.lights.empty()) return tree;
  return level_of(tree, params.level);
}

}  // namespace vsgl
