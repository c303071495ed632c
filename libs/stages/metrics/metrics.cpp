#include "stages/metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace vsgl::metrics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void require_same_length(Pixels test, Pixels reference) {
  if (test.size() != reference.size() || test.empty())
    throw Error(ErrorCode::internal, "metrics: spans of different length or without pixels");
}

// Mean of term(a, b) over all pixels.
template <typename Term>
double mean(Pixels test, Pixels reference, Term term) {
  require_same_length(test, reference);
  double sum = 0;
  for (std::size_t i = 0; i < test.size(); ++i)
    sum += term(static_cast<double>(test[i]), static_cast<double>(reference[i]));
  return sum / static_cast<double>(test.size());
}

double square(double x) {
  return x * x;
}
// 0 / 0 is 0: where nothing differs there is no error.
double ratio(double numerator, double denominator) {
  return numerator == 0 ? 0 : numerator / denominator;
}

}  // namespace

double mean_squared_error(Pixels test, Pixels reference) {
  return mean(test, reference, [](double a, double b) { return square(a - b); });
}

double root_mean_squared_error(Pixels test, Pixels reference) {
  return std::sqrt(mean_squared_error(test, reference));
}

double relative_mse(Pixels test, Pixels reference, double epsilon) {
  return mean(test, reference, [&](double a, double b) { return ratio(square(a - b), square(b) + epsilon); });
}

double relative_mse_epsilon(Pixels reference) {
  return square(0.01 * mean(reference, reference, [](double b, double) { return std::abs(b); }));
}

double mean_relative_squared_error(Pixels test, Pixels reference) {
  require_same_length(test, reference);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < test.size(); ++i) {
    const auto a = static_cast<double>(test[i]), b = static_cast<double>(reference[i]);
    if (b == 0) continue;
    sum += square((a - b) / b);
    ++count;
  }
  if (count > 0) return sum / static_cast<double>(count);
  return std::equal(test.begin(), test.end(), reference.begin()) ? 0 : kInfinity;
}

double mean_absolute_error(Pixels test, Pixels reference) {
  return mean(test, reference, [](double a, double b) { return std::abs(a - b); });
}

double symmetric_mean_absolute_percentage_error(Pixels test, Pixels reference) {
  return mean(test, reference,
              [](double a, double b) { return ratio(2 * std::abs(a - b), std::abs(a) + std::abs(b)); });
}

double peak_signal_to_noise_ratio(Pixels test, Pixels reference) {
  const double mse = mean_squared_error(test, reference);
  if (mse == 0) return kInfinity;
  const double peak =
      std::max(0.0, static_cast<double>(*std::max_element(reference.begin(), reference.end())));
  return 10 * std::log10(square(peak) / mse);
}

double bias(Pixels test, Pixels reference) {
  const double a = mean(test, reference, [](double x, double) { return x; });
  const double b = mean(test, reference, [](double, double x) { return x; });
  if (b == 0) return a == 0 ? 1 : kInfinity;
  return a / b;
}

Maximum maximum_error(Pixels test, Pixels reference) {
  require_same_length(test, reference);
  Maximum out;
  for (std::size_t i = 0; i < test.size(); ++i) {
    const double error = std::abs(static_cast<double>(test[i]) - static_cast<double>(reference[i]));
    if (error > out.error) out = {error, i};
  }
  return out;
}

std::size_t non_finite_count(Pixels pixels) {
  return static_cast<std::size_t>(
      std::count_if(pixels.begin(), pixels.end(), [](float v) { return !std::isfinite(v); }));
}

std::span<const ChannelMetric> channel_metrics() {
  using Epsilon = std::optional<double>;
  static constexpr ChannelMetric kMetrics[] = {
      {{"mse", "mean (a-b)^2", 0, Better::lower},
       [](Pixels a, Pixels b, Epsilon) { return mean_squared_error(a, b); }},
      {{"rmse", "sqrt(mse)", 0, Better::lower},
       [](Pixels a, Pixels b, Epsilon) { return root_mean_squared_error(a, b); }},
      {{"relmse", "mean (a-b)^2 / (b^2 + e), e = (mean|b| / 100)^2 or --relmse-epsilon", 0, Better::lower},
       [](Pixels a, Pixels b, Epsilon e) { return relative_mse(a, b, e ? *e : relative_mse_epsilon(b)); }},
      {{"mrse", "mean ((a-b) / b)^2 over pixels with b != 0", 0, Better::lower},
       [](Pixels a, Pixels b, Epsilon) { return mean_relative_squared_error(a, b); }},
      {{"mae", "mean |a-b|", 0, Better::lower},
       [](Pixels a, Pixels b, Epsilon) { return mean_absolute_error(a, b); }},
      {{"smape", "mean 2|a-b| / (|a|+|b|)", 0, Better::lower},
       [](Pixels a, Pixels b, Epsilon) { return symmetric_mean_absolute_percentage_error(a, b); }},
      {{"psnr_db", "10 log10((max b)^2 / mse)", kInfinity, Better::higher},
       [](Pixels a, Pixels b, Epsilon) { return peak_signal_to_noise_ratio(a, b); }},
      {{"max_error", "max |a-b|", 0, Better::lower},
       [](Pixels a, Pixels b, Epsilon) { return maximum_error(a, b).error; }},
      {{"bias", "mean(a) / mean(b)", 1, Better::nearer},
       [](Pixels a, Pixels b, Epsilon) { return bias(a, b); }},
  };
  return kMetrics;
}

bool within_limit(const Metric& metric, double value, double limit) {
  switch (metric.better) {
    case Better::lower:
      return value <= limit;
    case Better::higher:
      return value >= limit;
    case Better::nearer:
      return std::abs(value - metric.ideal) <= limit;
  }
  throw Error(ErrorCode::internal, "unknown Better");
}

}  // namespace vsgl::metrics
