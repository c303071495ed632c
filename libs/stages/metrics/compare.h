#pragma once

// Comparison of two artifacts, part by part, mip level by mip level and channel by channel, and of layers of
// radiance as images. docs/compare.md is its manual.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/exr.h"
#include "stages/metrics/layer_metrics.h"

namespace vsgl::metrics {

// A channel passes when at most `percent` of its pixels have |a - b| > `value` and none has |a - b| >
// `hard_limit`. In a UINT channel every pixel that differs counts as exceeding `value`; the hard limit does
// not apply to it.
struct Threshold {
  double value = 0;
  double percent = 0;                // 0..100
  std::optional<double> hard_limit;  // none: only `value` and `percent` decide
};

struct Options {
  std::optional<Threshold> threshold = Threshold{};      // none: only `limits` decide
  std::vector<std::pair<const Metric*, double>> limits;  // of every FLOAT channel, or of every layer
  std::vector<const Metric*> metrics;                    // to report; empty: all
  LayerOptions layers;
  bool z_test = false;  // judges the layer `indirect` by the variance of its channels; the reference has one
  std::optional<double> relmse_epsilon;
  bool allow_non_finite = false;  // pixels that are not finite on both sides are left out either way
  // Channels ("flux.R") or layers ("flux"). Empty `channels`: all. Each must be in one of the files.
  std::vector<std::string> channels, exclude;
};

// Why the two differ. `kind`: missing_part, missing_level, missing_channel, channel_type, size, non_finite,
// threshold, hard_limit, limit, z_exact (pixels without variance differ), z_pixel, z_rms, z_mean,
// nothing_compared.
struct Failure {
  std::string kind, part;
  int level = 0;
  std::string channel, message;
};

struct ChannelResult {
  std::string part, channel;
  int level = 0;
  bool is_uint = false;
  std::size_t pixels = 0;  // finite on both sides
  std::size_t non_finite_test = 0, non_finite_reference = 0;
  std::size_t differing = 0;  // pixels that are not equal
  std::size_t exceeding = 0;  // pixels above the threshold's value; UINT or no threshold: those that differ
  int max_x = 0, max_y = 0;   // the largest error; UINT: the first difference
  std::vector<std::pair<const Metric*, double>> metrics;  // FLOAT only
};

struct Comparison {
  std::vector<ChannelResult> channels;
  std::vector<LayerResult> layers;  // indirect, diffuse, specular, direct: those that both files have in RGB
  std::vector<Failure> failures;
  bool identical() const;  // no failure and no pixel that differs
};

// Throws bad_value when a name of `channels` or `exclude` is in neither file; missing_channel when a z-test
// is asked for and the reference has no variance; invalid_data when a variance is none.
Comparison compare(const ExrFile& test, const ExrFile& reference, const Options& options);

// The result as vsgltools/compare/1 (configs/schema/compare.schema.json). Numbers that are not finite become
// null.
nlohmann::ordered_json to_json(const Comparison& comparison, const ExrFile& test, const ExrFile& reference,
                               const Options& options);

}  // namespace vsgl::metrics
