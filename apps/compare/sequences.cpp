#include "sequences.h"

#include <charconv>

#include "base/frame_name.h"
#include "flags.h"
#include "html.h"
#include "stages/metrics/sequence.h"

namespace vsgl::app {
namespace {

constexpr int kMaxFrame = 999999999;

// "0:63"
std::pair<int, int> read_range(const std::string& text) {
  int first = 0, last = 0;
  const char* end = text.data() + text.size();
  const auto colon = std::from_chars(text.data(), end, first);
  const bool parted = colon.ec == std::errc() && colon.ptr != end && *colon.ptr == ':';
  const auto rest = parted ? std::from_chars(colon.ptr + 1, end, last) : colon;
  if (!parted || rest.ec != std::errc() || rest.ptr != end)
    throw Error(ErrorCode::bad_value, "--frames " + text + ": must be FIRST:LAST, as 0:63");
  if (first < 0 || last <= first || last > kMaxFrame)
    throw Error(ErrorCode::out_of_range, "--frames " + text + ": must be two frames or more, from 0");
  return {first, last};
}

const metrics::FlickerMetric& metric_named(const std::string& name) {
  std::string names;
  for (const metrics::FlickerMetric& metric : metrics::flicker_metrics()) {
    if (metric.name == name) return metric;
    names += (names.empty() ? "" : ", ") + std::string(metric.name);
  }
  throw Error(ErrorCode::bad_value, "--limit " + name + ": no metric of sequences; they have " + names);
}

metrics::FlickerLimits limits_of(const std::vector<std::string>& texts) {
  metrics::FlickerLimits limits;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw Error(ErrorCode::bad_value, "--limit " + text + ": must be METRIC=VALUE, as flicker=0.01");
    limits.emplace_back(&metric_named(text.substr(0, equals)),
                        number_of("--limit " + text, text.substr(equals + 1)));
  }
  return limits;
}

void summarise(Report& report, const nlohmann::ordered_json& result) {
  for (const char* name : {"result", "flicker", "flicker_interval", "flicker_raw", "bias_mean", "bias_rms",
                           "fluctuation", "step_p99", "pops", "versus"})
    if (!result[name].is_null()) report.count(name, result[name]);
  for (const auto& failure : result["failures"]) report.warn(failure["message"].get<std::string>());
}

// The first and the last frame, each with a viewer.
void write_page(const Tool& tool, const Inputs& inputs, const metrics::Sequence& test,
                const metrics::Sequence& reference, const nlohmann::ordered_json& result, bool passed,
                Report& report, OutputSet& outputs) {
  std::vector<ExrFile> files;
  for (const int frame : {test.first, test.last})
    for (const metrics::Sequence* sequence : {&test, &reference})
      files.push_back(read_exr(frame_path(sequence->files, frame)));
  const HtmlImages first{"Frame " + std::to_string(test.first), {{&files[0]}}, &files[1], {}};
  const HtmlImages last{"Frame " + std::to_string(test.last), {{&files[2]}}, &files[3], {}};
  write_html(tool, inputs.html, result, passed, {first, last}, {test.layer}, report, outputs);
}

}  // namespace

void declare_sequences(Tool& tool, SequenceArguments& a) {
  CLI::App& app = tool.app();
  app.add_option_function<std::string>(
      "--frames", [&a](const std::string& text) { a.frames = read_range(text); },
      "frames of sequences (A and B with %04d in their names) to compare, FIRST:LAST");
  app.add_option("--frame-rate", a.frame_rate_hz, "frames a second of sequences, for the spectrum")
      ->check(CLI::Range(0.001, 100000.0));
  tool.input("--versus", a.versus, "another sequence of the frames: does A flicker more than it?");
}

bool are_sequences(Tool& tool, const Inputs& inputs) {
  const bool test = names_frames(inputs.test), reference = names_frames(inputs.reference);
  if (test != reference)
    throw Error(ErrorCode::conflicting_options,
                (test ? inputs.reference : inputs.test).string() +
                    ": must be a sequence as the other is, with %04d in its name for the frame");
  if (!test)
    refuse(tool, {"--frames", "--frame-rate", "--versus"}, "two sequences, with %04d in their names");
  return test;
}

Exit compare_sequences(Tool& tool, const Inputs& inputs, const SequenceArguments& a, const std::string& layer,
                       const std::vector<std::string>& limit_texts, Report& report, OutputSet& outputs) {
  allow_only(tool, "sequences",
             {"test", "reference", "--output", "--html", "--limit", "--layer", "--frames", "--frame-rate",
              "--versus"});
  if (!a.frames)
    throw Error(ErrorCode::missing_option, "--frames: which frames of the sequences, FIRST:LAST");
  if (!a.versus.empty() && !names_frames(a.versus))
    throw Error(ErrorCode::bad_value, "--versus " + a.versus.string() + ": must have %04d for the frame");
  const metrics::FlickerLimits limits = limits_of(limit_texts);
  const auto sequence = [&](const std::filesystem::path& files) {
    return metrics::Sequence{files, a.frames->first, a.frames->second, layer.empty() ? "indirect" : layer};
  };
  const metrics::Sequence test = sequence(inputs.test), reference = sequence(inputs.reference);
  const auto measure = [&](const metrics::Sequence& frames) {
    const PhaseTimer timer(report, "measure");
    return metrics::measure_flicker(
        frames.frames(), [&](int i) { return frames.frame(i); }, [&](int i) { return reference.frame(i); },
        a.frame_rate_hz);
  };
  const metrics::FlickerResult result = measure(test);
  std::optional<metrics::Rival> rival;
  if (!a.versus.empty()) {
    rival = {a.versus.filename().string(), measure(sequence(a.versus)), {}};
    rival->difference = metrics::flicker_difference(result, rival->result);
  }
  const auto failures = metrics::judge(result, test, limits);
  const auto json =
      metrics::to_json(result, test, reference, a.frame_rate_hz, rival ? &*rival : nullptr, limits, failures);
  summarise(report, json);
  if (tool.common().json) report.count("comparison", json);
  if (!inputs.output.empty()) write_text(outputs.add(inputs.output), json.dump(2) + "\n");
  if (!inputs.html.empty())
    write_page(tool, inputs, test, reference, json, failures.empty(), report, outputs);
  return failures.empty() ? Exit::ok : Exit::differs;
}

}  // namespace vsgl::app
