#include "decomposition.h"

#include <cstdio>

#include "flags.h"
#include "html.h"
#include "stages/metrics/decomposition.h"

namespace vsgl::app {
namespace {

namespace fs = std::filesystem;

constexpr double kNotable = 0.1;  // a rise of relmse, in parts of the whole error's, that is warned of

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> out;
  std::size_t start = 0;
  for (std::size_t end = 0; end != std::string::npos; start = end + 1) {
    end = text.find(separator, start);
    out.push_back(text.substr(start, end == std::string::npos ? end : end - start));
  }
  return out;
}

metrics::CauseRemoved read_step(Tool& tool, const std::string& text, const std::string& layer) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw Error(
        ErrorCode::bad_value,
        "--step " + text + ": must be CAUSE=FILE or CAUSE=FILE,FILE,... with images of several seeds");
  metrics::CauseRemoved out{text.substr(0, equals), {}, {}};
  for (const std::string& file : split(text.substr(equals + 1), ',')) {
    out.images.push_back(metrics::read_frame(file, layer));
    tool.depends_on(file);
    out.files.push_back(fs::path(file).filename().string());
  }
  return out;
}

// The last cause of the chain needs a name of its own.
void check_name(const std::vector<metrics::CauseRemoved>& chain, const std::string& remainder) {
  const std::string& name = chain.back().cause;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i)
    if (chain[i].cause == name)
      throw Error(ErrorCode::bad_value, "--step " + name + ": is given twice; name each step once");
  if (name == remainder)
    throw Error(ErrorCode::bad_value,
                "--step " + name + ": is the name of what remains; give another --remainder");
}

std::optional<double> limit_of(const std::vector<std::string>& texts) {
  const std::string name = "remainder=";
  std::optional<double> limit;
  for (const std::string& text : texts) {
    if (limit || !text.starts_with(name))
      throw Error(ErrorCode::bad_value,
                  "--limit " + text + ": with --step there is one limit, as remainder=0.02");
    limit = number_of("--limit " + text, text.substr(name.size()));
    if (!(*limit >= 0)) throw Error(ErrorCode::out_of_range, "--limit " + text + ": must not be negative");
  }
  return limit;
}

// "share 0.312 [0.301, 0.322]  rms 0.0482  mean -0.0101  relmse after it 0.0031"
std::string row(const metrics::Step& step) {
  char text[160];
  std::snprintf(text, sizeof text,
                "share %7.4f [%.4f, %.4f]  rms %.5f  mean %+.5f [%+.5f, %+.5f]  relmse after it %.3g",
                step.share, step.share_interval.low, step.share_interval.high, step.rms, step.mean,
                step.mean_interval.low, step.mean_interval.high, step.relmse_after);
  return text;
}

void summarise(Report& report, const metrics::Decomposition& result, bool explained) {
  char text[160];
  report.count("result", explained ? "explained" : "unexplained");
  std::snprintf(text, sizeof text, "rms %.5f  mean %+.5f  relmse %.3g, of the whole error", result.rms,
                result.mean, result.relmse);
  report.count("total", text);
  for (const metrics::Step& step : result.steps) report.count(step.cause, row(step));
  report.count(result.remainder.cause, row(result.remainder));
  std::snprintf(text, sizeof text, "share %7.4f  rms %.5f", result.noise_share, result.noise_rms);
  report.count("noise of the reference", text);
}

void warn(Report& report, const metrics::Decomposition& result, bool explained) {
  double relmse = result.relmse;
  for (const metrics::Step& step : result.steps) {
    if (step.relmse_after > relmse + kNotable * result.relmse)
      report.warn("without its error of \"" + step.cause +
                  "\" the image is farther from the reference: errors cancel, or the image is another one's");
    relmse = step.relmse_after;
  }
  if (explained) return;
  char text[160];
  std::snprintf(
      text, sizeof text, "%.3g of the error's power remains [%.3g, %.3g]: the steps do not explain it",
      result.remainder.power, result.remainder.power_interval.low, result.remainder.power_interval.high);
  report.warn("step \"" + result.remainder.cause + "\": " + text);
}

// The chain as one viewer: A, what each step leaves (of several files the first), B.
void write_page(const Tool& tool, const Inputs& inputs, const DecompositionArguments& a,
                const std::string& layer, const nlohmann::ordered_json& result, bool explained,
                Report& report, OutputSet& outputs) {
  std::vector<ExrFile> files = {read_exr(inputs.reference), read_exr(inputs.test)};
  std::vector<std::string> labels = {"", ""};
  for (const std::string& step : a.steps) {
    const std::size_t equals = step.find('=');
    files.push_back(read_exr(split(step.substr(equals + 1), ',').front()));
    labels.push_back("without " + step.substr(0, equals));
  }
  HtmlImages images{"Chain", {}, &files.front(), {}};
  for (std::size_t i = 1; i < files.size(); ++i) images.tests.push_back({&files[i], labels[i]});
  write_html(tool, inputs.html, result, explained, {images}, {layer}, report, outputs);
}

}  // namespace

void declare_decomposition(Tool& tool, DecompositionArguments& a) {
  tool.app()
      .add_option(
          "--step", a.steps,
          "CAUSE=FILE: image in which one more cause of A's error is removed, in the order of the chain "
          "from A to B; several files, parted by commas, are averaged")
      ->allow_extra_args(false);
  tool.app()
      .add_option("--step-weights", a.weights,
                  "what a pixel's squares count: as they are, or relative to the reference's, as in relmse")
      ->check(CLI::IsMember({"absolute", "relative"}));
  tool.app().add_option("--remainder", a.remainder, "name of the step from the last of them to B");
}

bool is_decomposition(Tool& tool, const DecompositionArguments& a) {
  if (a.steps.empty()) refuse(tool, {"--remainder", "--step-weights"}, "--step");
  return !a.steps.empty();
}

Exit decompose_error(Tool& tool, const Inputs& inputs, const DecompositionArguments& a,
                     const std::string& layer_name, const std::vector<std::string>& limits, Report& report,
                     OutputSet& outputs) {
  allow_only(tool, "--step",
             {"test", "reference", "--output", "--html", "--limit", "--layer", "--step", "--remainder",
              "--step-weights"});
  const std::optional<double> limit = limit_of(limits);
  const std::string layer = layer_name.empty() ? "indirect" : layer_name;
  const metrics::Frame test = metrics::read_frame(inputs.test, layer);
  const metrics::Frame reference = metrics::read_frame(inputs.reference, layer);
  std::vector<metrics::CauseRemoved> chain;
  for (const std::string& step : a.steps) {
    chain.push_back(read_step(tool, step, layer));
    check_name(chain, a.remainder);
  }
  const auto weights = a.weights == "relative" ? metrics::Weights::relative : metrics::Weights::absolute;
  const metrics::Decomposition result = metrics::decompose(test, chain, reference, a.remainder, weights);
  const bool explained = metrics::is_explained(result, limit);
  warn(report, result, explained);
  const auto json = metrics::to_json(
      result, {inputs.test.filename().string(), inputs.reference.filename().string(), layer, weights}, limit);
  if (tool.common().json) {
    report.count("comparison", json);
  } else {
    summarise(report, result, explained);
  }
  if (!inputs.output.empty()) write_text(outputs.add(inputs.output), json.dump(2) + "\n");
  if (!inputs.html.empty()) write_page(tool, inputs, a, layer, json, explained, report, outputs);
  return explained ? Exit::ok : Exit::differs;
}

}  // namespace vsgl::app
