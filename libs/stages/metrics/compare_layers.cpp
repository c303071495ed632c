#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "stages/metrics/judging.h"

namespace vsgl::metrics {
namespace {

// What the metrics that are reported or limited need.
LayerOptions needed(const Options& options) {
  LayerOptions out = options.layers;
  const auto any_starts_with = [&](const std::string& prefix) {
    return std::any_of(layer_metrics().begin(), layer_metrics().end(), [&](const LayerMetric& metric) {
      const bool limited = std::any_of(options.limits.begin(), options.limits.end(),
                                       [&](const auto& limit) { return limit.first == &metric; });
      return metric.name.starts_with(prefix) && (limited || is_reported(options, metric));
    });
  };
  out.with_flip = any_starts_with("flip");
  out.with_ssim = any_starts_with("ssim");
  out.with_z = options.z_test || any_starts_with("z_");
  return out;
}

bool is_layer_selected(const Options& options, const std::string& name) {
  return is_selected(options, name + ".R") && is_selected(options, name + ".G") &&
         is_selected(options, name + ".B");
}

void check_z_test(const ZTest& z, const LayerResult& result, std::vector<Failure>& failures) {
  const auto fail = [&](const char* kind, const std::string& channel, const std::string& what) {
    failures.push_back(make_failure(kind, result.part, 0, channel, what));
  };
  const auto channel_name = [&](std::size_t c) { return result.layer + "." + "RGB"[c]; };
  const auto place = [&](std::size_t pixel) {
    const auto w = static_cast<std::size_t>(result.width);
    return std::to_string(pixel % w) + "," + std::to_string(pixel / w);
  };
  const std::string limit = ", beyond the critical value " + printed(z.critical);
  if (z.exact_differing > 0)
    fail("z_exact", result.layer,
         std::to_string(z.exact_differing) + " values without variance differ, the first at " +
             place(z.first_exact_pixel));
  if (z.exceeding > 0)
    fail("z_pixel", channel_name(z.worst_channel),
         std::to_string(z.exceeding) + " z-scores of all channels fail; the largest, at " +
             place(z.worst_pixel) + ", is " + printed(z.worst_score) + limit);
  for (std::size_t c = 0; c < 3; ++c) {
    const ZTest::Channel& channel = z.channels[c];
    if (channel.rms_score > z.critical)
      fail("z_rms", channel_name(c),
           "the z-scores have the root mean square " + printed(channel.rms) +
               "; the score of its excess over " + printed(kRmsTolerance) + " is " +
               printed(channel.rms_score) + limit);
    if (std::abs(channel.mean_score) > z.critical)
      fail("z_mean", channel_name(c),
           "the mean differs by " + printed(channel.mean_difference) + " with the standard error " +
               printed(channel.mean_standard_error) + ", a score of " + printed(channel.mean_score) + limit);
  }
}

}  // namespace

void compare_layers(const PartPair& pair, const std::string& test_path, const std::string& reference_path,
                    const Options& options, Comparison& out) {
  const LayerOptions layer_options = needed(options);
  const Uncertainty test = uncertainty_of(*pair.test, test_path);
  const Uncertainty reference = uncertainty_of(*pair.reference, reference_path);
  for (const std::string name : {"indirect", "diffuse", "specular", "direct"}) {
    if (!is_layer_selected(options, name)) continue;
    auto layer = extract_layer(*pair.test, *pair.reference, name);
    if (!layer) continue;
    if (options.z_test && name == "indirect" && reference.variance.empty())
      throw Error(ErrorCode::missing_channel,
                  reference_path +
                      ": variance.R: --z-test needs the variance of the reference; give a file "
                      "that has it");
    auto result = measure_layer(std::move(*layer), test, reference, layer_options);
    if (!result) continue;
    result->part = pair.reference->name;
    for (const LayerMetric& metric : layer_metrics())
      if (const auto value = metric.value(*result))
        check_limits(metric, *value, result->part, 0, result->layer, options, out);
    if (options.z_test && result->z) check_z_test(*result->z, *result, out.failures);
    out.layers.push_back(std::move(*result));
  }
}

}  // namespace vsgl::metrics
