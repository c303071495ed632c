// compare A.exr B.exr: does A hold the same as the reference B?

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <thread>

#include "artifact/header.h"
#include "base/tool.h"
#include "stages/metrics/compare.h"
#include "stages/metrics/pictures.h"

namespace {

namespace fs = std::filesystem;
using vsgl::metrics::Metric;

struct Arguments {
  fs::path test, reference;
  fs::path metrics_json, error_map, false_colour, side_by_side;
  double threshold = 0, fail_percent = 0;
  std::optional<double> hard_limit, relmse_epsilon;
  std::vector<std::string> limits, metrics, channels, exclude;
  bool allow_non_finite = false;
  std::string layer, exposure = "auto";
};

std::string list_of_metrics() {
  std::string text;
  for (const Metric& metric : vsgl::metrics::all_metrics())
    text += std::string(metric.name) + std::string(12 - metric.name.size(), ' ') +
            std::string(metric.formula) + "\n";
  text.pop_back();
  return text;
}

void declare(vsgl::Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  tool.input("test", a.test, "artifact to judge (A)")->required();
  tool.input("reference", a.reference, "artifact to judge it by (B)")->required();
  tool.output("-o,--output", a.metrics_json, "JSON with all figures");
  tool.output("--error-map", a.error_map, "EXR with |A - B| of each channel");
  tool.output("--false-color", a.false_colour,
              "PNG of the relative error of one layer, logarithmic, 1e-4 to 1");
  tool.output("--side-by-side", a.side_by_side, "PNG: A, B and the false colours in one row");
  app.add_option("--threshold", a.threshold, "largest |A - B| that is no difference")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--fail-percent", a.fail_percent, "percentage of pixels that may exceed --threshold")
      ->check(CLI::Range(0.0, 100.0));
  app.add_option("--hard-limit", a.hard_limit, "|A - B| that no pixel may exceed (default: none)")
      ->check(CLI::NonNegativeNumber);
  app.add_option(
      "--limit", a.limits,
      "METRIC=VALUE: bound on a metric of each channel; without --threshold only these bounds count");
  app.add_option("--metric", a.metrics, "metrics to report (default: all)");
  app.add_option("--relmse-epsilon", a.relmse_epsilon, "epsilon of relmse (default: (mean|B| / 100)^2)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--channels", a.channels, "compare only these channels (flux.R) or layers (flux)");
  app.add_option("--exclude", a.exclude, "leave out these channels or layers");
  app.add_flag("--allow-non-finite", a.allow_non_finite,
               "leave out pixels that are not finite instead of failing");
  app.add_option("--layer", a.layer,
                 "layer of the PNGs (default: indirect, or the first RGB layer, or the first channel)");
  app.add_option("--exposure", a.exposure,
                 "stops of the side-by-side PNG; auto: 95th percentile of B to 0.8");
  app.add_flag_callback(
      "--list-metrics", [] { throw CLI::CallForVersion(list_of_metrics(), 0); },
      "print the metrics with their formulas and exit");
}

const Metric& metric_named(const std::string& flag, const std::string& name) {
  if (const Metric* metric = vsgl::metrics::find_metric(name)) return *metric;
  throw vsgl::Error(vsgl::ErrorCode::bad_value, flag + " " + name + ": no such metric; see --list-metrics");
}

double number_of(const std::string& flag, const std::string& text) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size() && std::isfinite(value)) return value;
  } catch (const std::logic_error&) {
    // Falls through to the same message.
  }
  throw vsgl::Error(vsgl::ErrorCode::bad_value, flag + ": '" + text + "' is not a number");
}

vsgl::metrics::Options options_of(const Arguments& a, const CLI::App& app) {
  vsgl::metrics::Options options;
  for (const std::string& limit : a.limits) {
    const std::size_t equals = limit.find('=');
    if (equals == std::string::npos)
      throw vsgl::Error(vsgl::ErrorCode::bad_value,
                        "--limit " + limit + ": must be METRIC=VALUE, as relmse=1e-6");
    options.limits.emplace_back(&metric_named("--limit", limit.substr(0, equals)),
                                number_of("--limit " + limit, limit.substr(equals + 1)));
  }
  for (const std::string& name : a.metrics) options.metrics.push_back(&metric_named("--metric", name));
  const bool explicit_threshold =
      app.count("--threshold") + app.count("--fail-percent") + app.count("--hard-limit") > 0;
  if (options.limits.empty() || explicit_threshold) {
    options.threshold = {a.threshold, a.fail_percent, a.hard_limit};
  } else {
    options.threshold.reset();
  }
  options.relmse_epsilon = a.relmse_epsilon;
  options.allow_non_finite = a.allow_non_finite;
  options.channels = a.channels;
  options.exclude = a.exclude;
  return options;
}

// The report's figures; the first failures are also warnings, so that they reach stderr.
void summarise(vsgl::Report& report, const vsgl::metrics::Comparison& comparison,
               const nlohmann::ordered_json& result) {
  constexpr std::size_t kShown = 20;
  report.count("result", result["result"]);
  report.count("channels", comparison.channels.size());
  report.count("failures", comparison.failures.size());
  for (std::size_t i = 0; i < std::min(kShown, comparison.failures.size()); ++i)
    report.warn(comparison.failures[i].message);
  if (comparison.failures.size() > kShown)
    report.warn("and " + std::to_string(comparison.failures.size() - kShown) +
                " more differences; see --output");
}

void write_error_map(const Arguments& a, const vsgl::ExrFile& test, const vsgl::ExrFile& reference,
                     const vsgl::metrics::Options& options, const vsgl::Tool& tool, vsgl::Report& report,
                     vsgl::OutputSet& outputs) {
  auto map = vsgl::metrics::error_map(test, reference, options);
  if (!map) return report.skipped("error map", "the files share no channel of one size");
  const vsgl::ExrPart header = vsgl::artifact::make_part("", "error-map", tool.provenance());
  for (vsgl::ExrPart& part : map->parts) part.attributes = header.attributes;
  vsgl::artifact::write_parts(outputs.add(a.error_map), std::move(map->parts));
}

void write_pictures(const Arguments& a, const vsgl::ExrFile& test, const vsgl::ExrFile& reference,
                    vsgl::Report& report, vsgl::OutputSet& outputs) {
  const auto layer = vsgl::metrics::choose_layer(test, reference, a.layer);
  if (!layer) return report.skipped("pictures", "the files share no layer of one size");
  report.count("picture_layer", layer->name);
  if (!a.false_colour.empty())
    vsgl::metrics::write_png(outputs.add(a.false_colour), vsgl::metrics::false_colour(*layer));
  if (a.side_by_side.empty()) return;
  const double exposure =
      a.exposure == "auto" ? vsgl::metrics::automatic_exposure(*layer) : number_of("--exposure", a.exposure);
  report.count("exposure_stops", exposure);
  vsgl::metrics::write_png(outputs.add(a.side_by_side), vsgl::metrics::side_by_side(*layer, exposure));
}

vsgl::Exit run(const Arguments& a, const vsgl::Tool& tool, const vsgl::metrics::Options& options,
               vsgl::Report& report, vsgl::OutputSet& outputs) {
  const int threads = tool.common().threads;
  vsgl::set_exr_threads(threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency()));
  const auto read = [&](const fs::path& path) {
    const vsgl::PhaseTimer timer(report, "read");
    return vsgl::read_exr(path);
  };
  const vsgl::ExrFile test = read(a.test), reference = read(a.reference);
  vsgl::metrics::Comparison comparison;
  {
    const vsgl::PhaseTimer timer(report, "compare");
    comparison = vsgl::metrics::compare(test, reference, options);
  }
  const nlohmann::ordered_json result = vsgl::metrics::to_json(comparison, test, reference, options);
  summarise(report, comparison, result);
  if (tool.common().json) report.count("comparison", result);
  const vsgl::PhaseTimer timer(report, "write");
  if (!a.metrics_json.empty()) vsgl::write_text(outputs.add(a.metrics_json), result.dump(2) + "\n");
  if (!a.error_map.empty()) write_error_map(a, test, reference, options, tool, report, outputs);
  if (!a.false_colour.empty() || !a.side_by_side.empty()) write_pictures(a, test, reference, report, outputs);
  return comparison.failures.empty() ? vsgl::Exit::ok : vsgl::Exit::differs;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("compare", "compares two artifacts: metrics, thresholds, error maps");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(arguments, tool, options_of(arguments, tool.app()), report, outputs);
  });
}
