#include "stages/metrics/spectrum.h"

#include <cmath>
#include <numbers>

namespace vsgl::metrics {
namespace {

// The straight line of least squares.
void remove_trend(std::vector<double>& signal) {
  const auto n = static_cast<double>(signal.size());
  const double centre = (n - 1) / 2;
  double mean = 0, slope = 0;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    mean += signal[i] / n;
    slope += (static_cast<double>(i) - centre) * signal[i];
  }
  slope /= n * (n * n - 1) / 12;
  for (std::size_t i = 0; i < signal.size(); ++i)
    signal[i] -= mean + slope * (static_cast<double>(i) - centre);
}

}  // namespace

PowerSpectrum::PowerSpectrum(std::size_t length) {
  for (std::size_t i = 0; i < length; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(length);
    cosines_.push_back(std::cos(turn));
    sines_.push_back(std::sin(turn));
    window_.push_back((1 - cosines_.back()) / 2);
    window_power_ += window_.back() * window_.back() / static_cast<double>(length);
  }
}

std::vector<double> PowerSpectrum::of(std::vector<double> signal) const {
  const std::size_t n = window_.size();
  remove_trend(signal);
  for (std::size_t i = 0; i < n; ++i) signal[i] *= window_[i];
  std::vector<double> out;
  for (std::size_t k = 1; k <= n / 2; ++k) {
    double real = 0, imaginary = 0;
    for (std::size_t i = 0; i < n; ++i) {
      real += signal[i] * cosines_[i * k % n];
      imaginary += signal[i] * sines_[i * k % n];
    }
    const double sides = 2 * k == n ? 1 : 2;  // of positive and negative frequency
    out.push_back(sides * (real * real + imaginary * imaginary) /
                  (static_cast<double>(n * n) * window_power_));
  }
  return out;
}

}  // namespace vsgl::metrics
