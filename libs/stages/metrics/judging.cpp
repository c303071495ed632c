#include "stages/metrics/judging.h"

#include <algorithm>
#include <sstream>

namespace vsgl::metrics {

std::string printed(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

Failure make_failure(const std::string& kind, const std::string& part, int level, const std::string& channel,
                     const std::string& what) {
  std::string place;
  if (!part.empty()) place += "part '" + part + "', ";
  if (level > 0) place += "level " + std::to_string(level) + ", ";
  if (!channel.empty()) place += "channel '" + channel + "', ";
  if (!place.empty()) place.replace(place.size() - 2, 2, ": ");
  return {kind, part, level, channel, place + what};
}

bool is_reported(const Options& options, const Metric& metric) {
  return options.metrics.empty() ||
         std::find(options.metrics.begin(), options.metrics.end(), &metric) != options.metrics.end();
}

void check_limits(const Metric& metric, double value, const std::string& part, int level,
                  const std::string& channel, const Options& options, Comparison& out) {
  for (const auto& [limited, limit] : options.limits)
    if (limited == &metric && !within_limit(metric, value, limit))
      out.failures.push_back(make_failure(
          "limit", part, level, channel,
          std::string(metric.name) + " is " + printed(value) + ", beyond the limit " + printed(limit)));
}

void check_coverage(const Options& options, Comparison& out) {
  if (!out.failures.empty()) return;
  const auto nothing = [&](const std::string& what) {
    out.failures.push_back(make_failure("nothing_compared", "", 0, "", what));
  };
  const auto some_layer = [&](const auto& has) {
    return std::any_of(out.layers.begin(), out.layers.end(), has);
  };
  if (out.channels.empty()) return nothing("no channel was compared; check --channels and --exclude");
  if (options.z_test && !some_layer([](const LayerResult& layer) { return layer.z.has_value(); }))
    nothing("--z-test found nothing to test: it takes the layer indirect; check --channels and --exclude");
  for (const LayerMetric& metric : layer_metrics()) {
    const bool limited = std::any_of(options.limits.begin(), options.limits.end(),
                                     [&](const auto& limit) { return limit.first == &metric; });
    if (limited && !some_layer([&](const LayerResult& layer) { return metric.value(layer).has_value(); }))
      nothing("--limit " + std::string(metric.name) + " found nothing to bound: no layer has that metric");
  }
}

}  // namespace vsgl::metrics
