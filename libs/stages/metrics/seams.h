#pragma once

// Steps of the error along the borders of an image's tiles. docs/compare.md has the formulas.

#include <cstddef>
#include <optional>
#include <vector>

#include "stages/metrics/layer.h"

namespace vsgl::metrics {

// Steps are of the relative error (Yt - Yr) / (|Yr| + 2% of the image's mean |Yr|), each the mean over a line
// of up to `tile` pairs of pixels on either side of it. Of lines at the borders of tiles, and of the two
// lines before and behind each of those, inside the tiles.
struct Seams {
  struct Steps {
    double median = 0, p99 = 0, max = 0;
  };
  int tile = 0;
  std::size_t borders = 0;       // that were measured
  std::size_t left_out = 0;      // with too few pairs of like brightness
  Steps border, interior;        // magnitudes
  Steps excess;                  // of each border beyond the mean of its interior lines; may be negative
  int worst_x = 0, worst_y = 0;  // the first pixel behind the border with the largest excess
  bool worst_is_vertical = false;
};

// `left_out`: 1 for pixels that do not count (blacken_non_finite). Nothing when no border can be measured.
// tile >= 6.
std::optional<Seams> measure_seams(const LayerPair& layer, const std::vector<char>& left_out, int tile);

}  // namespace vsgl::metrics
