#include "stages/metrics/statistics.h"

#include <cmath>
#include <numeric>

namespace vsgl::metrics {

double quantile(const std::vector<double>& sorted, double q) {
  const double place = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 == sorted.size()) return sorted.back();
  return std::lerp(sorted[below], sorted[below + 1], place - static_cast<double>(below));
}

double weighted_quantile(const std::vector<double>& sorted, double q) {
  const double wanted = q * std::accumulate(sorted.begin(), sorted.end(), 0.0);
  double sum = 0;
  for (const double value : sorted) {
    sum += value;
    if (sum >= wanted) return value;
  }
  return sorted.back();
}

LogHistogram log_histogram(const std::vector<double>& values) {
  LogHistogram out;
  for (const double value : values) {
    if (value <= 0) {
      ++out.zero_or_less;
      continue;
    }
    const double place =
        std::floor(LogHistogram::kBinsPerDecade * (std::log10(value) - LogHistogram::kFirstDecade));
    if (place < 0) {
      ++out.below;
    } else if (place >= static_cast<double>(out.counts.size())) {
      ++out.above;
    } else {
      ++out.counts[static_cast<std::size_t>(place)];
    }
  }
  return out;
}

}  // namespace vsgl::metrics
