#include "html.h"

#include <algorithm>

#include "report/document.h"
#include "report/tables.h"
#include "stages/metrics/score_map.h"

namespace vsgl::app {
namespace {

std::string name_of(const ExrFile& file) {
  return std::filesystem::path(file.path).filename().string();
}

// Nothing when the files share no layer.
std::optional<report::Images> viewer(const HtmlImages& images, const std::vector<std::string>& channels) {
  std::vector<const ExrFile*> files = {images.reference};
  for (const HtmlImages::Test& test : images.tests) files.push_back(test.file);
  const std::vector<std::string> layers = report::shared_layers(files, channels);
  if (layers.empty()) return std::nullopt;
  report::Images out;
  out.reference = report::make_picture(*images.reference, name_of(*images.reference), layers);
  for (const auto& [file, label] : images.tests)
    out.tests.push_back({report::make_picture(*file, label.empty() ? name_of(*file) : label, layers), {}});
  for (const report::ErrorMap& map : images.maps)
    if (map.width == out.reference.width && map.height == out.reference.height)
      out.tests.front().maps.push_back(map);
  out.exposure = report::automatic_exposure(out.reference.layers.front());
  return out;
}

// The file's name, which some results hold in an object.
std::string file_of(const nlohmann::ordered_json& side) {
  return (side.is_object() ? side["file"] : side).get<std::string>();
}

std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

// A map of `layer`, black where a side is not finite.
report::ErrorMap map_of(const std::string& name, const metrics::LayerPair& layer,
                        report::ErrorMap::Scale scale, std::vector<float> values) {
  return {.name = name,
          .layer = layer.name,
          .scale = scale,
          .limit = 5,
          .width = layer.width,
          .height = layer.height,
          .values = std::move(values)};
}

}  // namespace

std::vector<report::ErrorMap> html_maps(const ExrFile& test, const ExrFile& reference,
                                        const std::string& layer, const metrics::LayerOptions& options) {
  using Scale = report::ErrorMap::Scale;
  std::vector<report::ErrorMap> maps;
  auto pair = metrics::choose_layer(test, reference, layer);
  if (!pair) return maps;
  const metrics::Uncertainty of_test = metrics::uncertainty_of(test.parts.front(), test.path),
                             of_reference = metrics::uncertainty_of(reference.parts.front(), reference.path);
  if (pair->name == "indirect" && !(of_test.variance.empty() && of_reference.variance.empty()))
    maps.push_back(
        map_of("z-score", *pair, Scale::signed_, metrics::score_map(*pair, of_test, of_reference)));
  metrics::blacken_non_finite(*pair);
  const metrics::Grid flip = metrics::flip(*pair, options.flip_mode, options.flip_pixels_per_degree).map;
  maps.push_back(map_of("FLIP", *pair, Scale::unit, {flip.values.begin(), flip.values.end()}));
  return maps;
}

void declare_html(Tool& tool, std::filesystem::path& file) {
  tool.output("--html", file, "page with images, error maps, histograms and tables, in one file");
}

void write_html(const Tool& tool, const std::filesystem::path& file, const nlohmann::ordered_json& result,
                bool passed, const std::vector<HtmlImages>& images, const std::vector<std::string>& channels,
                Report& report, OutputSet& outputs) {
  report::Document document;
  document.title = file_of(result["test"]) + " against " + file_of(result["reference"]);
  document.verdict = spaced(result["result"]);
  document.passed = passed;
  document.failures = report::failures_of_result(result);
  document.made_by = tool.provenance();
  for (const HtmlImages& pair : images) {
    if (auto shown = viewer(pair, channels)) {
      document.sections.push_back({pair.title, {std::move(*shown)}, {}});
    } else {
      report.skipped("images of the page", "the files share no layer of one size");
    }
  }
  report::Section figures{"Figures", {}, {}};
  for (report::Table& table : report::tables_of_result(result)) figures.content.push_back(std::move(table));
  document.sections.push_back(std::move(figures));
  write_text(outputs.add(file), report::render(document));
}

}  // namespace vsgl::app
