#pragma once

// The cut: the nodes of a light tree that each tile of an image needs, within an error. docs/cut.md states
// the criterion.

#include "artifact/artifact.h"
#include "base/report.h"

namespace vsgl {

struct CutParams {
  double error = 0.1;  // RMSE over the mean of the image that the user accepts, 1e-5..1
};

// Unshadowed: visibility is not known. Throws invalid_data when `lights` is not a tree or has another anchor,
// out_of_range.
Cut build_cut(const GBuffer& gbuffer, const Lights& lights, const CutParams& params, Report& report);

}  // namespace vsgl
