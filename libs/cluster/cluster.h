#pragma once

// Filtered virtual point lights (FVPLs): clusters of lit texels as shading evaluates them.
// docs/mathematics.md derives the formulas, math/fvpl.h is the double-precision oracle.

#include <vector>

#include "artifact/artifact.h"
#include "interop/cluster.h"

namespace vsgl {

// All lights, in their order. Variances are floored at (1e-6 scene radius)^2.
std::vector<interop::Cluster> pack_clusters(const Lights& lights);

}  // namespace vsgl
