#pragma once

// Do two images that were measured with known variance have the same mean? docs/compare.md has the formulas.

#include <array>
#include <optional>
#include <vector>

#include "stages/metrics/layer.h"

namespace vsgl::metrics {

// How well an image is known.
struct Uncertainty {
  std::vector<Colour> variance;  // of the mean, per channel, >= 0; empty: the image is exact
  std::optional<int> passes;     // independent passes that it was estimated from, >= 2; none: taken as exact
};

// What the level-0 channels variance.R/G/B and the attribute reference.passes of a part say. Throws
// invalid_data when a variance is negative or not finite, or there are fewer than two passes.
Uncertainty uncertainty_of(const ExrPart& part, const std::string& path);

struct ZTest {
  // Of one colour channel, over its tested pixels.
  struct Channel {
    std::size_t tested = 0;
    double rms = 0;        // of the scores, about 1 when the variances are right
    double rms_score = 0;  // how unlikely so large an rms is, as a normal deviate
    double mean_difference = 0, mean_standard_error = 0;
    double mean_score = 0;
  };
  double significance = 0.05;       // chance of any false alarm
  double critical = 0;              // |score| beyond which a test fails
  std::size_t tests = 0;            // all of them: pixels x channels and two for each channel
  std::size_t exceeding = 0;        // values whose |score| exceeds `critical`
  std::size_t exact = 0;            // values without variance that are equal: nothing to test
  std::size_t exact_differing = 0;  // values without variance that differ
  double worst_score = 0;           // of a value, signed
  std::size_t worst_pixel = 0, worst_channel = 0;
  std::size_t first_exact_pixel = 0;  // of exact_differing
  std::array<Channel, 3> channels;
};

// How far the rms may exceed 1 before it counts: estimated variances are themselves off by some percent.
constexpr double kRmsTolerance = 1.2;

// `left_out`: pixels that do not count, as blacken_non_finite() gives them. At least one image has a
// variance. 0 < significance < 1.
ZTest z_test(const LayerPair& layer, const std::vector<char>& left_out, const Uncertainty& test,
             const Uncertainty& reference, double significance);

// (test - reference) / standard error of one value, as a normal deviate; nothing where it has no variance.
std::optional<double> value_score(const LayerPair& layer, const Uncertainty& test,
                                  const Uncertainty& reference, std::size_t pixel, std::size_t channel);

// The normal deviate as unlikely as `t` of Student's distribution with so many degrees of freedom (> 0, may
// be infinite).
double normal_score(double t, double degrees_of_freedom);

}  // namespace vsgl::metrics
