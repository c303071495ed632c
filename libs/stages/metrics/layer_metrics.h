#pragma once

// Metrics of whole RGB layers of radiance. docs/compare.md has the formulas.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stages/metrics/flip.h"
#include "stages/metrics/metrics.h"
#include "stages/metrics/seams.h"
#include "stages/metrics/statistics.h"
#include "stages/metrics/z_test.h"

namespace vsgl::metrics {

// How two images of a layer differ. Optional parts are there where they were asked for and can be measured.
struct LayerResult {
  std::string part, layer;
  int width = 0, height = 0;
  std::size_t pixels = 0;      // finite on both sides; the others are black on both sides for flip and ssim
  std::size_t non_finite = 0;  // the others

  struct Flip {
    FlipMode mode = FlipMode::hdr;
    double pixels_per_degree = 0;
    ExposureRange exposures;
    std::size_t out_of_range = 0;
    double mean = 0, max = 0;
    std::array<double, 3> weighted_quartiles{};  // half of all error lies in pixels up to the second
  };
  std::optional<Flip> flip;

  struct Ssim {
    double exposure_stops = 0;
    double mean = 0, min = 0;
  };
  std::optional<Ssim> ssim;

  double relmse = 0, relmse_trimmed = 0;
  std::optional<double> relmse_denoised, relmse_trimmed_denoised;  // with a variance of the reference
  double luminance_bias = 1;                                       // mean of the test / mean of the reference
  std::optional<double> luminance_bias_error;  // its standard error, with a variance of either

  struct Errors {
    std::array<double, 5> percentiles{};  // at kPercentiles
    LogHistogram histogram;
  };
  Errors absolute, relative;                   // of the luminance
  LogHistogram values_test, values_reference;  // luminances
  std::optional<ZTest> z;                      // of `indirect`, with a variance of either
  std::optional<Seams> seams;                  // where the image has tiles with borders
};

constexpr std::array<double, 5> kPercentiles = {50, 90, 95, 99, 99.9};

// A metric of a layer; nothing where the result lacks it.
struct LayerMetric : Metric {
  std::optional<double> (*value)(const LayerResult& result);
};
std::span<const LayerMetric> layer_metrics();

// Metrics of channels and of layers, in the order of the tables; nullptr when there is none of that name.
std::vector<const Metric*> all_metrics();
const Metric* find_metric(std::string_view name);

struct LayerOptions {
  FlipMode flip_mode = FlipMode::hdr;
  double flip_pixels_per_degree = kFlipPixelsPerDegree;
  double significance = 0.05;  // of the z-test
  int seam_tile = 0;           // pixels a side of the tiles whose seams are measured, 6 or more; 0: none are
  bool with_flip = true, with_ssim = true, with_z = true;
};

// Nothing when no pixel is finite on both sides. Variances belong to the layer `indirect`: `test` and
// `reference` are ignored for others.
std::optional<LayerResult> measure_layer(LayerPair layer, const Uncertainty& test,
                                         const Uncertainty& reference, const LayerOptions& options);

}  // namespace vsgl::metrics
