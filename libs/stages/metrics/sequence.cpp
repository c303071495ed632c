#include "stages/metrics/sequence.h"

#include <cmath>

#include "base/error.h"
#include "base/frame_name.h"
#include "stages/metrics/judging.h"
#include "stages/metrics/z_test.h"

namespace vsgl::metrics {
namespace {

using Json = nlohmann::ordered_json;

void check_finite(const std::vector<Colour>& colours, int width, const std::string& where) {
  for (std::size_t i = 0; i < colours.size(); ++i)
    for (const float v : colours[i])
      if (!std::isfinite(v))
        throw Error(ErrorCode::non_finite, where + ": " + (std::isnan(v) ? "NaN" : "infinite") + " at (" +
                                               std::to_string(i % width) + "," + std::to_string(i / width) +
                                               "); look for the cause in the tool that wrote the file");
}

Json interval_json(const Interval& interval) {
  return {interval.low, interval.high};
}

Json rival_json(const FlickerResult& result, const Rival& rival) {
  return {{"test", rival.name},
          {"flicker", rival.result.flicker},
          {"difference", result.flicker - rival.result.flicker},
          {"difference_interval", interval_json(rival.difference)}};
}

}  // namespace

Frame read_frame(const std::filesystem::path& path, const std::string& layer) {
  const ExrFile file = read_exr(path);
  for (const ExrPart& part : file.parts) {
    auto colours = colours_of(part, layer);
    if (!colours) continue;
    check_finite(*colours, part.width(), file.path + ": layer \"" + layer + "\"");
    Frame frame{part.width(), part.height(), std::move(*colours), {}};
    if (layer == "indirect") frame.variance = uncertainty_of(part, file.path).variance;
    return frame;
  }
  throw Error(ErrorCode::missing_channel, file.path + ": there is no layer \"" + layer +
                                              "\"; give --layer an RGB layer or a FLOAT channel of the file");
}

Frame Sequence::frame(int index) const {
  return read_frame(frame_path(files, first + index), layer);
}

std::vector<SequenceFailure> judge(const FlickerResult& result, const Sequence& test,
                                   const FlickerLimits& limits) {
  std::vector<SequenceFailure> failures;
  const auto name = [&](int index) { return frame_path(test.files, test.first + index).filename().string(); };
  for (const int frame : result.repeated)
    failures.push_back(
        {"repeated_frame", name(frame) + " repeats the frame before, but the reference changes"});
  for (const auto& [frame, offset] : result.misaligned)
    failures.push_back({"misaligned_frame", name(frame) + " looks like the reference's frame " +
                                                (offset < 0 ? "before" : "after")});
  for (const auto& [metric, limit] : limits)
    if (const double value = metric->value(result); !within_limit(*metric, value, limit))
      failures.push_back({"limit", std::string(metric->name) + " is " + printed(value) +
                                       ", beyond the limit of " + printed(limit)});
  return failures;
}

Json to_json(const FlickerResult& result, const Sequence& test, const Sequence& reference,
             double frame_rate_hz, const Rival* rival, const FlickerLimits& limits,
             const std::vector<SequenceFailure>& failures) {
  Json out{{"$schema", "vsgltools/flicker/1"},
           {"test", test.files.filename().string()},
           {"reference", reference.files.filename().string()},
           {"layer", test.layer},
           {"first_frame", test.first},
           {"last_frame", test.last},
           {"frame_rate_hz", frame_rate_hz},
           {"result", failures.empty() ? "within_limits" : "differs"},
           {"pixels", result.pixels},
           {"reference_mean", result.mean}};
  for (const FlickerMetric& metric : flicker_metrics()) out[std::string(metric.name)] = metric.value(result);
  out["flicker_interval"] = interval_json(result.flicker_interval);
  out["bias_mean"] = result.bias_mean;
  out["rmse"] = result.rmse;
  out["step_rms"] = result.step_rms;
  out["spectrum"] = nullptr;
  if (const auto& s = result.spectrum)
    out["spectrum"] = {{"all", s->all}, {"fast", s->fast}, {"visible", s->visible}};
  out["misaligned"] = Json::array();
  for (const auto& [frame, offset] : result.misaligned)
    out["misaligned"].push_back({{"frame", test.first + frame}, {"offset", offset}});
  out["repeated"] = Json::array();
  for (const int frame : result.repeated) out["repeated"].push_back(test.first + frame);
  out["versus"] = rival ? rival_json(result, *rival) : Json();
  out["limits"] = Json::object();
  for (const auto& [metric, limit] : limits) out["limits"][std::string(metric->name)] = limit;
  out["failures"] = Json::array();
  for (const SequenceFailure& failure : failures)
    out["failures"].push_back({{"kind", failure.kind}, {"message", failure.message}});
  return out;
}

}  // namespace vsgl::metrics
