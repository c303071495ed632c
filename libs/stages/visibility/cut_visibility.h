#pragma once

// A cut with visibility, tile by tile.

#include "base/report.h"
#include "stages/visibility/sight.h"
#include "stages/visibility/tile_visibility.h"
#include "stages/visibility/visibility.h"

namespace vsgl::visibility {

// Chooses the cut of `tree` with the visibility that `sight` knows, within params.error, or takes the entries
// of `given` as they are, and finds out which pixels see them.
Cut find_cut_visibility(const GBuffer& gbuffer, const Lights& tree, const Cut* given, const Sight& sight,
                        const VisibilityParams& params, Report& report);

}  // namespace vsgl::visibility
