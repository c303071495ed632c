#pragma once

// FLIP: how much a viewer notices when two images are shown in turn, 0..1 per pixel. [Andersson 2020] for
// images of a display, [Andersson 2021] for radiance. docs/compare.md has the formulas.

#include <array>
#include <optional>
#include <vector>

#include "stages/metrics/grid.h"
#include "stages/metrics/layer.h"

namespace vsgl::metrics {

// The papers' observer: 0.7 m in front of a display that is 0.7 m and 3840 pixels wide.
constexpr double kFlipPixelsPerDegree = 67;

// Linear RGB, each 0..1.
using RgbGrid = std::array<Grid, 3>;

// The error of each pixel. `pixels_per_degree` > 0.
Grid ldr_flip(const RgbGrid& test, const RgbGrid& reference, double pixels_per_degree);

// Exposures in stops, `count` of them evenly from `start` to `stop`.
struct ExposureRange {
  double start = 0, stop = 0;
  int count = 1;
  double stops(int index) const { return count > 1 ? start + (stop - start) * index / (count - 1) : start; }
};
// [Andersson 2021] From the exposure that brings the reference's brightest luminance to 85% of
// white behind the tone mapper to the one that does so with its median. Deviation: the median runs over the
// positive luminances only, so that a background may be black. Without any the range is the exposure 0 alone.
ExposureRange hdr_exposures(const std::vector<Colour>& reference);

// The ACES tone mapping curve of [Narkowicz 2016], without its built-in exposure of 0.6; 0..1. Domain: x >=
// 0.
double tone_map(double x);

enum class FlipMode { hdr, ldr };
struct FlipResult {
  Grid map;
  ExposureRange exposures;  // hdr only
  std::size_t out_of_range =
      0;  // pixels of either image with a value that the mode cannot show: below 0; ldr: above 1
};
// hdr: the largest error over the exposures of hdr_exposures(). ldr: values are the display's linear light.
// Negative values (ldr: and those above 1) are shown as the nearest that can be. All values must be finite.
FlipResult flip(const LayerPair& layer, FlipMode mode, double pixels_per_degree);

}  // namespace vsgl::metrics
