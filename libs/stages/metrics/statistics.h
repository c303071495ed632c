#pragma once

// Distributions of per-pixel values.

#include <array>
#include <cstddef>
#include <vector>

namespace vsgl::metrics {

// The value below which the share `q` (0..1) of `sorted` lies, between two values linearly. `sorted`: rising,
// not empty.
double quantile(const std::vector<double>& sorted, double q);

// The smallest value such that those up to it hold the share `q` of the sum of all. 0 when all are 0.
// `sorted`: rising, not negative, not empty.
double weighted_quantile(const std::vector<double>& sorted, double q);

// Counts in steps of a quarter of a decade from 1e-8 to 1e4.
struct LogHistogram {
  static constexpr int kFirstDecade = -8, kDecades = 12, kBinsPerDecade = 4;
  std::size_t zero_or_less = 0, below = 0, above = 0;  // <= 0; less than 1e-8; 1e4 and more
  std::array<std::size_t, kDecades * kBinsPerDecade> counts{};
};
LogHistogram log_histogram(const std::vector<double>& values);

}  // namespace vsgl::metrics
