#include "stages/visibility/maps.h"

#include <cmath>

#include "base/error.h"
#include "stages/visibility/cut_visibility.h"
#include "stages/visibility/ism.h"
#include "stages/visibility/map_sight.h"

namespace vsgl::visibility {
namespace {

constexpr double kMaps = 1024;

// The level with about kMaps nodes, or the one asked for.
std::uint32_t choose_level(const Lights& tree, int asked) {
  const auto levels = static_cast<std::uint32_t>(tree.levels.size() - 1);
  if (asked >= static_cast<int>(levels))
    throw Error(ErrorCode::out_of_range, "level: " + std::to_string(asked) + " is outside -1.." +
                                             std::to_string(levels - 1) + ", the levels of this tree");
  if (asked >= 0) return static_cast<std::uint32_t>(asked);
  std::uint32_t best = 0;
  const auto distance = [&](std::uint32_t level) {
    return std::abs(
        std::log(static_cast<double>(level_nodes(tree.lights, tree.levels, level).size()) / kMaps));
  };
  for (std::uint32_t level = 1; level < levels; ++level)
    if (distance(level) < distance(best)) best = level;
  return best;
}

}  // namespace

Visibility map_cut(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device* device,
                   Report& report) {
  const Lights& tree = inputs.lights;
  const std::uint32_t level = choose_level(tree, params.level);
  const std::vector<std::uint32_t> mapped = level_nodes(tree.lights, tree.levels, level);
  report.count("level", level);
  Lights level_lights = tree;
  level_lights.levels.clear();
  level_lights.lights.clear();
  for (const std::uint32_t node : mapped) level_lights.lights.push_back(tree.lights[node]);
  const ShadowMaps maps = render_shadow_maps(inputs.scene, level_lights, params, *device, report);
  std::vector<interop::vec3> normals;
  for (const interop::Light& light : tree.lights) normals.push_back(light.normal);
  const PhaseTimer timer(report, "lookups");
  const MapSight sight(*inputs.gbuffer, tree, normals, maps, mapped);
  return find_cut_visibility(*inputs.gbuffer, tree, inputs.cut, sight, params, report);
}

}  // namespace vsgl::visibility
