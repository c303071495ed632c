#pragma once

#include <vector>

#include "stages/lights/tree_split.h"

namespace vsgl {

// The lights of all nodes, in their order: powers summed, statistics merged by the law of total variance in
// double precision. Nodes without texels have no power and take all else from their parent.
std::vector<interop::Light> tree_lights(const Rsm& rsm, const TexelTree& tree);

}  // namespace vsgl
