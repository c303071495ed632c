#pragma once

// Pieces of the result's JSON. Private to this library.

#include "stages/metrics/compare.h"

namespace vsgl::metrics {

using Json = nlohmann::ordered_json;

// null when it is not finite, or not there.
Json number(double value);
Json number(const std::optional<double>& value);

Json describe(const LayerResult& result, const Options& options);

}  // namespace vsgl::metrics
