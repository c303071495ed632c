#include <filesystem>

#include "stages/metrics/json_values.h"

namespace vsgl::metrics {
namespace {

// The file's name without its folder, and the kind of artifact that it says it is.
Json describe(const ExrFile& file) {
  const auto& attributes = file.parts.front().attributes;
  const auto it = attributes.find("vsgl.schema");
  const auto* kind = it == attributes.end() ? nullptr : std::get_if<std::string>(&it->second);
  return {{"file", std::filesystem::path(file.path).filename().string()},
          {"kind", kind ? Json(*kind) : Json(nullptr)}};
}

Json describe(const std::optional<Threshold>& threshold) {
  if (!threshold) return nullptr;
  return {{"value", threshold->value},
          {"fail_percent", threshold->percent},
          {"hard_limit", number(threshold->hard_limit)}};
}

Json describe(const ChannelResult& result) {
  Json out = {{"part", result.part},           {"level", result.level},
              {"channel", result.channel},     {"type", result.is_uint ? "uint" : "float"},
              {"pixels", result.pixels},       {"differing", result.differing},
              {"exceeding", result.exceeding}, {"worst_pixel", {result.max_x, result.max_y}}};
  if (result.is_uint) return out;
  out["non_finite_test"] = result.non_finite_test;
  out["non_finite_reference"] = result.non_finite_reference;
  out["metrics"] = Json::object();
  for (const auto& [metric, value] : result.metrics)
    out["metrics"][std::string(metric->name)] = number(value);
  return out;
}

Json describe(const Failure& failure) {
  return {{"kind", failure.kind},
          {"part", failure.part},
          {"level", failure.level},
          {"channel", failure.channel},
          {"message", failure.message}};
}

}  // namespace

nlohmann::ordered_json to_json(const Comparison& comparison, const ExrFile& test, const ExrFile& reference,
                               const Options& options) {
  Json limits = Json::object();
  for (const auto& [metric, limit] : options.limits) limits[std::string(metric->name)] = limit;
  Json channels = Json::array(), layers = Json::array(), failures = Json::array();
  for (const ChannelResult& result : comparison.channels) channels.push_back(describe(result));
  for (const LayerResult& result : comparison.layers) layers.push_back(describe(result, options));
  for (const Failure& failure : comparison.failures) failures.push_back(describe(failure));
  const char* verdict = !comparison.failures.empty() ? "differs"
                        : comparison.identical()     ? "same"
                                                     : "within_thresholds";
  return {{"$schema", "vsgltools/compare/1"},
          {"test", describe(test)},
          {"reference", describe(reference)},
          {"result", verdict},
          {"threshold", describe(options.threshold)},
          {"limits", limits},
          {"relmse_epsilon", number(options.relmse_epsilon)},
          {"allow_non_finite", options.allow_non_finite},
          {"z_test", options.z_test},
          {"channels", channels},
          {"layers", layers},
          {"failures", failures}};
}

}  // namespace vsgl::metrics
