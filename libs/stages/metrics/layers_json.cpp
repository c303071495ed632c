#include <cmath>

#include "stages/metrics/json_values.h"
#include "stages/metrics/judging.h"

namespace vsgl::metrics {
namespace {

Json describe(const LayerResult::Flip& flip) {
  return {{"mode", flip.mode == FlipMode::hdr ? "hdr" : "ldr"},
          {"pixels_per_degree", flip.pixels_per_degree},
          {"start_exposure_stops", flip.exposures.start},
          {"stop_exposure_stops", flip.exposures.stop},
          {"exposures", flip.exposures.count},
          {"out_of_range", flip.out_of_range},
          {"mean", flip.mean},
          {"weighted_quartiles", flip.weighted_quartiles},
          {"max", flip.max}};
}

Json describe(const LayerResult::Ssim& ssim) {
  return {
      {"encoding", "pu21"}, {"exposure_stops", ssim.exposure_stops}, {"mean", ssim.mean}, {"min", ssim.min}};
}

Json describe(const LogHistogram& histogram) {
  return {{"zero_or_less", histogram.zero_or_less},
          {"below", histogram.below},
          {"counts", histogram.counts},
          {"above", histogram.above}};
}

Json percentiles_of(const LayerResult::Errors& errors) {
  Json out = Json::array();
  for (const double value : errors.percentiles) out.push_back(number(value));
  return out;
}

Json bias_of(const LayerResult& result) {
  Json interval = nullptr;
  if (result.luminance_bias_error) {
    const double half = 1.959964 * *result.luminance_bias_error;  // 95% of a normal distribution
    interval = {number(result.luminance_bias - half), number(result.luminance_bias + half)};
  }
  return {{"ratio", number(result.luminance_bias)},
          {"standard_error", number(result.luminance_bias_error)},
          {"interval_95", interval}};
}

Json describe(const ZTest& z, int width) {
  Json channels = Json::array();
  for (std::size_t c = 0; c < z.channels.size(); ++c) {
    const ZTest::Channel& channel = z.channels[c];
    channels.push_back({{"channel", std::string(1, "RGB"[c])},
                        {"tested", channel.tested},
                        {"rms", number(channel.rms)},
                        {"rms_score", number(channel.rms_score)},
                        {"mean_difference", number(channel.mean_difference)},
                        {"mean_standard_error", number(channel.mean_standard_error)},
                        {"mean_score", number(channel.mean_score)}});
  }
  const auto w = static_cast<std::size_t>(width);
  return {{"significance", z.significance},
          {"tests", z.tests},
          {"critical_score", z.critical},
          {"exceeding", z.exceeding},
          {"exact", z.exact},
          {"exact_differing", z.exact_differing},
          {"worst_score", number(z.worst_score)},
          {"worst_pixel", {z.worst_pixel % w, z.worst_pixel / w}},
          {"worst_channel", std::string(1, "RGB"[z.worst_channel])},
          {"channels", channels}};
}

Json describe(const Seams::Steps& steps) {
  return {{"median", number(steps.median)}, {"p99", number(steps.p99)}, {"max", number(steps.max)}};
}

Json describe(const Seams& seams) {
  return {{"tile", seams.tile},
          {"borders", seams.borders},
          {"left_out", seams.left_out},
          {"border", describe(seams.border)},
          {"interior", describe(seams.interior)},
          {"excess", describe(seams.excess)},
          {"worst_pixel", {seams.worst_x, seams.worst_y}},
          {"worst_border", seams.worst_is_vertical ? "vertical" : "horizontal"}};
}

}  // namespace

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json number(const std::optional<double>& value) {
  return value ? number(*value) : Json(nullptr);
}

Json describe(const LayerResult& result, const Options& options) {
  Json metrics = Json::object();
  for (const LayerMetric& metric : layer_metrics()) {
    const std::optional<double> value = metric.value(result);
    if (value && is_reported(options, metric)) metrics[std::string(metric.name)] = number(*value);
  }
  return {{"part", result.part},
          {"layer", result.layer},
          {"pixels", result.pixels},
          {"non_finite", result.non_finite},
          {"metrics", metrics},
          {"flip", result.flip ? describe(*result.flip) : Json(nullptr)},
          {"ssim", result.ssim ? describe(*result.ssim) : Json(nullptr)},
          {"luminance_bias", bias_of(result)},
          {"percentiles",
           {{"at", kPercentiles},
            {"absolute", percentiles_of(result.absolute)},
            {"relative", percentiles_of(result.relative)}}},
          {"histograms",
           {{"first_log10", LogHistogram::kFirstDecade},
            {"bins_per_decade", LogHistogram::kBinsPerDecade},
            {"error_absolute", describe(result.absolute.histogram)},
            {"error_relative", describe(result.relative.histogram)},
            {"test", describe(result.values_test)},
            {"reference", describe(result.values_reference)}}},
          {"seams", result.seams ? describe(*result.seams) : Json(nullptr)},
          {"z_test", result.z ? describe(*result.z, result.width) : Json(nullptr)}};
}

}  // namespace vsgl::metrics
