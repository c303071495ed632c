#include "stages/visibility/map_sight.h"

#include <algorithm>

#include "math/interop_vec.h"
#include "stages/visibility/shadow_lookup.h"

namespace vsgl::visibility {
namespace {

double power_of(const interop::Light& light) {
  return luminance(to_double(light.power_diffuse) + to_double(light.power_specular));
}

constexpr std::uint32_t kNone = ~0U;

}  // namespace

MapSight::MapSight(const GBuffer& gbuffer, const Lights& tree, std::span<const interop::vec3> normals,
                   const ShadowMaps& maps, std::span<const std::uint32_t> mapped)
    : Sight(gbuffer, tree, normals), maps_(maps), maps_of_(tree.lights.size(), {kNone, kNone}) {
  for (std::uint32_t i = 0; i < mapped.size(); ++i) maps_of_[mapped[i]] = {i, i};
  for (std::size_t i = 0; i < tree.lights.size(); ++i) {
    const std::uint32_t first = tree.lights[i].children;
    for (std::uint32_t k = 0; k < 4 && first != 0 && maps_of_[i][0] != kNone; ++k)
      maps_of_[first + k] = maps_of_[i];
  }
  // Children come after their parents: upwards, of the two strongest children one map each.
  for (std::size_t i = tree.lights.size(); i-- > 0;) {
    if (maps_of_[i][0] != kNone) continue;
    std::array<std::uint32_t, 4> children;
    for (std::uint32_t k = 0; k < 4; ++k) children[k] = tree.lights[i].children + k;
    std::stable_sort(children.begin(), children.end(), [&](std::uint32_t a, std::uint32_t b) {
      return power_of(tree.lights[a]) > power_of(tree.lights[b]);
    });
    const bool single = power_of(tree.lights[children[1]]) == 0;
    maps_of_[i] = {maps_of_[children[0]][0], maps_of_[children[single ? 0 : 1]][0]};
  }
}

Seen MapSight::see(std::span<const Pair> pairs) const {
  Seen seen;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (facing_point(pairs[i]) == nullptr) continue;
    seen.facing |= 1U << i;
    const Vec3 position = to_double(pixel(pairs[i]).position), normal = to_double(pixel(pairs[i]).normal);
    const auto [a, b] = maps_of_[pairs[i].node];
    double visible = shadow_visibility(maps_, a, position, normal);
    if (a != b) visible = (visible + shadow_visibility(maps_, b, position, normal)) / 2;
    if (visible >= 0.5) seen.visible |= 1U << i;
  }
  return seen;
}

}  // namespace vsgl::visibility
