#pragma once

#include <cmath>
#include <vector>

#include "densities.h"

namespace vsgl::test {

struct ChiSquare {
  double statistic = 0;
  double z = 0;  // its normal score, by Wilson and Hilferty's cube root
};

// Samples per texel against `density`; texels of fewer than 5 expected samples are pooled in reading order.
inline ChiSquare chi_square(const std::vector<int>& counts, const TestDensity& density) {
  double samples = 0;
  for (int n : counts) samples += n;
  ChiSquare out;
  double expected = 0, observed = 0, cells = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    expected += samples * static_cast<double>(density.pyramid[k]) / static_cast<double>(counts.size());
    observed += counts[k];
    if (expected < 5) continue;
    out.statistic += std::pow(observed - expected, 2) / expected;
    cells += 1;
    expected = observed = 0;
  }
  const double freedom = cells - 1, part = 2 / (9 * freedom);
  out.z = (std::cbrt(out.statistic / freedom) - (1 - part)) / std::sqrt(part);
  return out;
}

}  // namespace vsgl::test
