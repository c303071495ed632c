#pragma once

#include <cstddef>
#include <vector>

namespace vsgl::metrics {

// How the mean square of a signal spreads over frequencies. Its linear trend is taken out and a Hann window
// laid over it, whose loss of power is made good; a sinusoid leaks into the bins next to its own.
class PowerSpectrum {
 public:
  // length >= 4.
  explicit PowerSpectrum(std::size_t length);
  // At the frequencies k / length, k = 1 .. length / 2, in cycles a sample. The sum is the mean square of
  // what is not trend.
  std::vector<double> of(std::vector<double> signal) const;

 private:
  std::vector<double> window_, cosines_, sines_;  // the latter of whole turns times i / length
  double window_power_ = 0;                       // mean square
};

}  // namespace vsgl::metrics
