#pragma once

// Which part of an error comes from which cause: along a chain of images from the one under test to the
// reference, each with one more cause removed, the error is the sum of the steps. docs/compare.md has the
// formulas.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "stages/metrics/bootstrap.h"
#include "stages/metrics/sequence.h"

namespace vsgl::metrics {

// The image in which a cause is removed besides those before it.
struct CauseRemoved {
  std::string cause;
  std::vector<Frame>
      images;  // of different seeds: their mean counts, and their spread tells how well it is known
  std::vector<std::string> files;
};

struct Step {
  std::string cause;
  std::vector<std::string> files;  // of the image behind it
  double mean = 0;                 // of the luminance / that of the reference
  Interval mean_interval;
  double rms = 0;    // / mean of the reference, without noise of means over seeds and of the reference
  double power = 0;  // rms^2 / that of the whole error; may be negative, where noise is subtracted
  double share = 0;  // <step, error> / <error, error>; all shares and that of the noise add up to 1
  Interval power_interval, share_interval;  // 95%, as that of the mean
  double relmse_after = 0;  // of the image behind it: mean of the metric relmse of the three channels
};

struct Decomposition {
  std::size_t pixels = 0;
  double reference_mean = 0;              // luminance
  double mean = 0, rms = 0, relmse = 0;   // of the whole error, as in Step
  std::vector<Step> steps;                // in the order of the chain
  Step remainder;                         // from the last image to the reference
  double noise_rms = 0, noise_share = 0;  // of the reference
  bool unexplained() const { return remainder.power_interval.low > 0; }  // more than noise remains
};

// What a pixel's products count: as they are, or divided by the square of the reference there, so that dark
// pixels count as much as bright ones, as in relmse.
enum class Weights { absolute, relative };

// Intervals are of bootstraps over blocks of pixels. Throws wrong_size; invalid_data when the reference is
// black, or when an image of the mean behind a step is the one before it, whose own noise the step would
// hide.
Decomposition decompose(const Frame& test, const std::vector<CauseRemoved>& chain, const Frame& reference,
                        const std::string& remainder, Weights weights = Weights::absolute);

// The result as vsgltools/decomposition/1 (configs/schema/decomposition.schema.json). `limit`: the largest
// power of the remainder that does not matter; none: what is within noise. `names`: test and reference.
struct DecompositionNames {
  std::string test, reference, layer;
  Weights weights = Weights::absolute;
};
nlohmann::ordered_json to_json(const Decomposition& result, const DecompositionNames& names,
                               const std::optional<double>& limit);

// Whether the remainder is within the limit, or without one within noise.
bool is_explained(const Decomposition& result, const std::optional<double>& limit);

}  // namespace vsgl::metrics
