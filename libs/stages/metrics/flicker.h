#pragma once

// How a sequence of images flickers: what changes from frame to frame that does not change in the reference.
// docs/compare.md has the formulas.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "stages/metrics/bootstrap.h"
#include "stages/metrics/layer.h"
#include "stages/metrics/metrics.h"

namespace vsgl::metrics {

struct Frame {
  int width = 0, height = 0;
  std::vector<Colour> colours;   // finite, row by row from the top-left
  std::vector<Colour> variance;  // of the colours, >= 0; empty: exact
};
// Gives the frame of an index from 0. Called several times for some; not more than five frames are held.
using Frames = std::function<Frame(int index)>;

struct FlickerResult {
  int frames = 0;
  std::size_t pixels = 0;  // that are not black in all frames of both sequences
  // Mean luminance of the reference over all frames and those of its pixels that are not black in all of
  // them; all figures down to the spectrum are relative to it, but for the relative ones.
  double mean = 0;

  double flicker = 0;  // root mean square of the change of the error from a frame to the next, without noise
  double flicker_raw = 0;           // with the reference's noise
  double flicker_relative = 0;      // of the change divided by the pixel's own luminance
  Interval flicker_interval;        // 95%
  std::vector<double> step_rms;     // flicker_raw of each step, frames - 1
  std::vector<Sums> block_changes;  // what `flicker` is made of: squares of changes, their noise, terms

  double bias_mean = 0;    // mean error, signed
  double bias_rms = 0;     // of the pixels' mean errors over time
  double fluctuation = 0;  // rms of the errors about those; rmse^2 = bias_rms^2 + fluctuation^2
  double rmse = 0;

  double step_p99 = 0, step_p999 = 0;  // percentiles of the relative change of luminance, to 0.3%
  std::size_t pops = 0;                // pixels and steps where it exceeds 10%

  // Errors of blocks of 8 x 8 pixels over time, rms; with 64 frames or more.
  struct Spectrum {
    double all = 0;
    double fast = 0;     // above a quarter of the frame rate
    double visible = 0;  // 5 to 20 Hz
  };
  std::optional<Spectrum> spectrum;

  struct Misaligned {
    int frame, offset;  // the frame looks like the reference's frame + offset
  };
  std::vector<Misaligned> misaligned;
  std::vector<int> repeated;  // frames that equal the one before, where the reference changes
};

// Throws wrong_size when frames differ in size, and invalid_data when the reference is black. frames >= 2,
// frame_rate_hz > 0.
FlickerResult measure_flicker(int frames, const Frames& test, const Frames& reference, double frame_rate_hz);

// `flicker` of the first less that of the second, both against the same reference frames: 95% interval of a
// paired bootstrap. Without 0 in it one of the two flickers more.
Interval flicker_difference(const FlickerResult& first, const FlickerResult& second);

// A figure of a sequence that --limit may bound.
struct FlickerMetric : Metric {
  double (*value)(const FlickerResult& result);
};
std::span<const FlickerMetric> flicker_metrics();

}  // namespace vsgl::metrics
