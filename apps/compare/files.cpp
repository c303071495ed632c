#include "files.h"

#include <algorithm>
#include <thread>

#include "html.h"
#include "stages/metrics/compare.h"

namespace vsgl::app {
namespace {

using metrics::Metric;

std::string list_of_metrics() {
  std::size_t width = 0;
  for (const Metric* metric : metrics::all_metrics()) width = std::max(width, metric->name.size());
  std::string text;
  for (const Metric* metric : metrics::all_metrics())
    text += std::string(metric->name) + std::string(width + 2 - metric->name.size(), ' ') +
            std::string(metric->formula) + "\n";
  text.pop_back();
  return text;
}

const Metric& metric_named(const std::string& flag, const std::string& name) {
  if (const Metric* metric = metrics::find_metric(name)) return *metric;
  throw Error(ErrorCode::bad_value, flag + " " + name + ": no such metric; see --list-metrics");
}

metrics::Options options_of(const FilesArguments& a, const CLI::App& app) {
  metrics::Options options;
  for (const std::string& limit : a.limits) {
    const std::size_t equals = limit.find('=');
    if (equals == std::string::npos)
      throw Error(ErrorCode::bad_value, "--limit " + limit + ": must be METRIC=VALUE, as relmse=1e-6");
    options.limits.emplace_back(&metric_named("--limit", limit.substr(0, equals)),
                                number_of("--limit " + limit, limit.substr(equals + 1)));
  }
  for (const std::string& name : a.metrics) options.metrics.push_back(&metric_named("--metric", name));
  const bool explicit_threshold =
      app.count("--threshold") + app.count("--fail-percent") + app.count("--hard-limit") > 0;
  if ((options.limits.empty() && !a.z_test) || explicit_threshold) {
    options.threshold = {a.threshold, a.fail_percent, a.hard_limit};
  } else {
    options.threshold.reset();
  }
  options.relmse_epsilon = a.relmse_epsilon;
  options.layers.flip_mode = a.flip_mode == "hdr" ? metrics::FlipMode::hdr : metrics::FlipMode::ldr;
  options.layers.flip_pixels_per_degree = a.flip_ppd;
  options.layers.significance = a.significance;
  options.layers.seam_tile = a.seam_tile;
  options.z_test = a.z_test;
  options.allow_non_finite = a.allow_non_finite;
  options.channels = a.channels;
  options.exclude = a.exclude;
  return options;
}

// The report's figures; the first failures are also warnings, so that they reach stderr.
void summarise(Report& report, const metrics::Comparison& comparison, const nlohmann::ordered_json& result) {
  constexpr std::size_t kShown = 20;
  report.count("result", result["result"]);
  report.count("channels", comparison.channels.size());
  report.count("layers", comparison.layers.size());
  report.count("failures", comparison.failures.size());
  for (std::size_t i = 0; i < std::min(kShown, comparison.failures.size()); ++i)
    report.warn(comparison.failures[i].message);
  if (comparison.failures.size() > kShown)
    report.warn("and " + std::to_string(comparison.failures.size() - kShown) +
                " more differences; see --output");
}

}  // namespace

void declare_files(Tool& tool, FilesArguments& a) {
  CLI::App& app = tool.app();
  declare_maps(tool, a.maps);
  app.add_option("--threshold", a.threshold, "largest |A - B| that is no difference")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--fail-percent", a.fail_percent, "percentage of pixels that may exceed --threshold")
      ->check(CLI::Range(0.0, 100.0));
  app.add_option("--hard-limit", a.hard_limit, "|A - B| that no pixel may exceed (default: none)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--limit", a.limits,
                 "METRIC=VALUE: bound on a metric of each channel or layer; without --threshold only these "
                 "bounds count");
  app.add_option("--metric", a.metrics, "metrics to report (default: all)");
  app.add_option("--relmse-epsilon", a.relmse_epsilon, "epsilon of relmse (default: (mean|B| / 100)^2)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--flip-mode", a.flip_mode,
                 "hdr: over the exposures of a viewer; ldr: 0..1 is what a display shows")
      ->check(CLI::IsMember({"hdr", "ldr"}));
  app.add_option("--flip-ppd", a.flip_ppd, "pixels per degree of the viewer's field of view")
      ->check(CLI::Range(1.0, 1000.0));
  app.add_option("--seams", a.seam_tile,
                 "measure steps of the error at the borders of tiles of that many pixels a side")
      ->check(CLI::Range(6, 4096));
  app.add_flag(
      "--z-test", a.z_test,
      "judge the layer indirect by the variance that B (and A) state; without --threshold only this counts");
  app.add_option("--significance", a.significance,
                 "chance that --z-test finds a difference where there is none")
      ->check(CLI::Range(1e-9, 0.5));
  app.add_option("--channels", a.channels, "compare only these channels (flux.R) or layers (flux)");
  app.add_option("--exclude", a.exclude, "leave out these channels or layers");
  app.add_flag("--allow-non-finite", a.allow_non_finite,
               "leave out pixels that are not finite instead of failing");
  app.add_flag_callback(
      "--list-metrics", [] { throw CLI::CallForVersion(list_of_metrics(), 0); },
      "print the metrics with their formulas and exit");
}

Exit compare_files(Tool& tool, const Inputs& inputs, const FilesArguments& a, Report& report,
                   OutputSet& outputs) {
  const metrics::Options options = options_of(a, tool.app());
  const int threads = tool.common().threads;
  set_exr_threads(threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency()));
  const auto read = [&](const std::filesystem::path& path) {
    const PhaseTimer timer(report, "read");
    return read_exr(path);
  };
  const ExrFile test = read(inputs.test), reference = read(inputs.reference);
  metrics::Comparison comparison;
  {
    const PhaseTimer timer(report, "compare");
    comparison = metrics::compare(test, reference, options);
  }
  const nlohmann::ordered_json result = metrics::to_json(comparison, test, reference, options);
  summarise(report, comparison, result);
  if (tool.common().json) report.count("comparison", result);

  const PhaseTimer timer(report, "write");
  if (!inputs.output.empty()) write_text(outputs.add(inputs.output), result.dump(2) + "\n");
  write_maps(tool, a.maps, test, reference, options, report, outputs);
  if (!inputs.html.empty()) {
    const HtmlImages images{
        "Images", {{&test}}, &reference, html_maps(test, reference, a.maps.layer, options.layers)};
    write_html(tool, inputs.html, result, comparison.failures.empty(), {images}, a.channels, report, outputs);
  }
  return comparison.failures.empty() ? Exit::ok : Exit::differs;
}

}  // namespace vsgl::app
