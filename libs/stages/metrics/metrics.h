#pragma once

// Differences between a test signal a and a reference b, one number each. Sums run in double, in the order of
// the pixels. Both spans have the same length and hold finite values. What is undefined is infinite;
// docs/compare.md has all formulas.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace vsgl::metrics {

using Pixels = std::span<const float>;

// mean (a - b)^2, and its root.
double mean_squared_error(Pixels test, Pixels reference);
double root_mean_squared_error(Pixels test, Pixels reference);

// mean (a - b)^2 / (b^2 + epsilon). Infinite when a denominator is 0 where the two differ.
double relative_mse(Pixels test, Pixels reference, double epsilon);
// (mean |b| / 100)^2: pixels darker than 1% of the mean do not dominate, and the scale of the image does not
// matter.
double relative_mse_epsilon(Pixels reference);

// mean of ((a - b) / b)^2 over the pixels with b != 0. Without any: 0 when the two are equal, else infinite.
double mean_relative_squared_error(Pixels test, Pixels reference);

// mean |a - b|.
double mean_absolute_error(Pixels test, Pixels reference);

// mean of 2 |a - b| / (|a| + |b|), 0..2; a pixel with a = b = 0 adds nothing.
double symmetric_mean_absolute_percentage_error(Pixels test, Pixels reference);

// 10 log10(peak^2 / MSE) in dB, peak = max b. Infinite for equal signals, minus infinity without a positive
// peak.
double peak_signal_to_noise_ratio(Pixels test, Pixels reference);

// mean a / mean b. 1 when both means are 0, infinite when only b's is.
double bias(Pixels test, Pixels reference);

struct Maximum {
  double error = 0;       // max |a - b|
  std::size_t index = 0;  // the first pixel that has it
};
Maximum maximum_error(Pixels test, Pixels reference);

// How many values are NaN or infinite.
std::size_t non_finite_count(Pixels pixels);

// What --list-metrics, --metric, --limit and the result's JSON say of a metric.
enum class Better { lower, higher, nearer };  // which of two values is better; nearer: to the ideal
struct Metric {
  std::string_view name;     // JSON key: "relmse"
  std::string_view formula;  // one line of text
  double ideal;              // the value of equal signals
  Better better;
};

// A metric of one channel.
struct ChannelMetric : Metric {
  // `relmse_epsilon`: replaces relative_mse_epsilon() where given.
  double (*evaluate)(Pixels test, Pixels reference, std::optional<double> relmse_epsilon);
};
std::span<const ChannelMetric> channel_metrics();

// Whether `value` is on the right side of `limit`: at most (lower), at least (higher), at most so far from
// the ideal (nearer).
bool within_limit(const Metric& metric, double value, double limit);

}  // namespace vsgl::metrics
