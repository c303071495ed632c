#pragma once

// What makes a comparison fail. Private to this library.

#include <string>

#include "stages/metrics/compare.h"
#include "stages/metrics/pairing.h"

namespace vsgl::metrics {

// As a stream prints it: six digits.
std::string printed(double value);

// `what`, behind the place as far as it has a name. `channel`: a channel, a layer, or empty.
Failure make_failure(const std::string& kind, const std::string& part, int level, const std::string& channel,
                     const std::string& what);

bool is_reported(const Options& options, const Metric& metric);

// Adds a failure for each limit on `metric` that `value` breaks.
void check_limits(const Metric& metric, double value, const std::string& part, int level,
                  const std::string& channel, const Options& options, Comparison& out);

// Adds results and failures of the layers that both parts of a pair have. The paths are for messages.
void compare_layers(const PartPair& pair, const std::string& test_path, const std::string& reference_path,
                    const Options& options, Comparison& out);

// Adds a failure when nothing at all failed because what was asked for could not be compared.
void check_coverage(const Options& options, Comparison& out);

}  // namespace vsgl::metrics
