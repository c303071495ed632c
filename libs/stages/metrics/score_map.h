#pragma once

// Where two images differ by more than their noise.

#include "stages/metrics/z_test.h"

namespace vsgl::metrics {

// For each pixel the score (test - reference) / standard error, as a normal deviate, of the channel where it
// is largest in magnitude. 0 where no channel has a variance. At least one image has a variance. Scores of
// pixels that are not finite are not finite.
std::vector<float> score_map(const LayerPair& layer, const Uncertainty& test, const Uncertainty& reference);

}  // namespace vsgl::metrics
