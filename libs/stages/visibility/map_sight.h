#pragma once

#include <array>

#include "stages/visibility/sight.h"

namespace vsgl::visibility {

// By shadow maps of the nodes of level_nodes(): deeper nodes use the map of their ancestor, shallower
// ones the mean of two descendants'.
class MapSight final : public Sight {
 public:
  // maps.views[i] is of mapped[i].
  MapSight(const GBuffer& gbuffer, const Lights& tree, std::span<const interop::vec3> normals,
           const ShadowMaps& maps, std::span<const std::uint32_t> mapped);
  Seen see(std::span<const Pair> pairs) const override;
  const char* name() const override { return "lookups"; }

 private:
  const ShadowMaps& maps_;
  std::vector<std::array<std::uint32_t, 2>> maps_of_;  // of each node; twice the same for a single one
};

}  // namespace vsgl::visibility
