#pragma once

#include <vector>

#include "artifact/artifact.h"
#include "stages/visibility/patches.h"

namespace vsgl::visibility {

// How many of a patch's points are wanted where the view and the light matter, for each patch: its area, half
// of it times how near the patch is to the paths of light from `lights` to what `gbuffer` sees (1 on
// average). The areas themselves where no such path is found; `pairs` counts those that were.
struct ViewImportance {
  std::vector<double> weights;
  std::size_t pairs = 0;
};
ViewImportance view_importance(const std::vector<Vec3>& centres, const std::vector<double>& areas,
                               const Lights& lights, const GBuffer& gbuffer, std::uint64_t seed);

}  // namespace vsgl::visibility
