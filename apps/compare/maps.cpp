#include "maps.h"

#include "artifact/header.h"
#include "inputs.h"
#include "stages/metrics/pictures.h"
#include "stages/metrics/ssim.h"

namespace vsgl::app {
namespace {

void write_error_map(const Tool& tool, const MapArguments& a, const ExrFile& test, const ExrFile& reference,
                     const metrics::Options& options, Report& report, OutputSet& outputs) {
  auto map = metrics::error_map(test, reference, options);
  if (!map) return report.skipped("error map", "the files share no channel of one size");
  const ExrPart header = artifact::make_part("", "error-map", tool.provenance());
  for (ExrPart& part : map->parts) part.attributes = header.attributes;
  artifact::write_parts(outputs.add(a.error_map), std::move(map->parts));
}

void write_pictures(const MapArguments& a, const ExrFile& test, const ExrFile& reference, Report& report,
                    OutputSet& outputs) {
  const auto layer = metrics::choose_layer(test, reference, a.layer);
  if (!layer) return report.skipped("pictures", "the files share no layer of one size");
  report.count("picture_layer", layer->name);
  if (!a.false_colour.empty()) metrics::write_png(outputs.add(a.false_colour), metrics::false_colour(*layer));
  if (a.side_by_side.empty()) return;
  const double exposure =
      a.exposure == "auto" ? metrics::automatic_exposure(*layer) : number_of("--exposure", a.exposure);
  report.count("exposure_stops", exposure);
  metrics::write_png(outputs.add(a.side_by_side), metrics::side_by_side(*layer, exposure));
}

// A value per pixel of `layer`: a PNG in the colours of `shade`, which brings values to 0..1, or else an EXR.
void write_map(const Tool& tool, const std::filesystem::path& path, const std::string& name,
               const metrics::Grid& map, double (*shade)(double), OutputSet& outputs) {
  if (path.extension() == ".png") {
    metrics::Picture picture{map.width, map.height, {}};
    for (const double value : map.values)
      for (const std::uint8_t c : metrics::map_colour(shade(value))) picture.rgb.push_back(c);
    return metrics::write_png(outputs.add(path), picture);
  }
  ExrPart part = artifact::make_part("", name + "-map", tool.provenance());
  ExrLevel level{map.width, map.height, {}};
  level.channels[name + ".V"] = std::vector<float>(map.values.begin(), map.values.end());
  part.levels = {std::move(level)};
  artifact::write_parts(outputs.add(path), {std::move(part)});
}

void write_perceived(const Tool& tool, const MapArguments& a, const ExrFile& test, const ExrFile& reference,
                     const metrics::LayerOptions& options, Report& report, OutputSet& outputs) {
  auto layer = metrics::choose_layer(test, reference, a.layer);
  if (!layer) return report.skipped("maps of FLIP and SSIM", "the files share no layer of one size");
  metrics::blacken_non_finite(*layer);
  if (!a.flip_map.empty())
    write_map(
        tool, a.flip_map, "flip",
        metrics::flip(*layer, options.flip_mode, options.flip_pixels_per_degree).map,
        [](double error) { return error; }, outputs);
  if (!a.ssim_map.empty())
    write_map(
        tool, a.ssim_map, "ssim", metrics::ssim(*layer, metrics::automatic_exposure(*layer)),
        [](double similarity) { return 1 - similarity; }, outputs);
}

}  // namespace

void declare_maps(Tool& tool, MapArguments& a) {
  tool.output("--error-map", a.error_map, "EXR with |A - B| of each channel");
  tool.output("--false-color", a.false_colour,
              "PNG of the relative error of one layer, logarithmic, 1e-4 to 1");
  tool.output("--side-by-side", a.side_by_side, "PNG: A, B and the false colours in one row");
  tool.output("--flip-map", a.flip_map, "PNG or EXR: FLIP of each pixel of one layer");
  tool.output("--ssim-map", a.ssim_map, "PNG or EXR: SSIM of each pixel of one layer");
  tool.app().add_option(
      "--layer", a.layer,
      "layer of pictures and maps (default: indirect, or the first RGB layer, or the first channel)");
  tool.app().add_option("--exposure", a.exposure,
                        "stops of the side-by-side PNG; auto: 95th percentile of B to 0.8");
}

void write_maps(const Tool& tool, const MapArguments& a, const ExrFile& test, const ExrFile& reference,
                const metrics::Options& options, Report& report, OutputSet& outputs) {
  if (!a.error_map.empty()) write_error_map(tool, a, test, reference, options, report, outputs);
  if (!a.false_colour.empty() || !a.side_by_side.empty()) write_pictures(a, test, reference, report, outputs);
  if (!a.flip_map.empty() || !a.ssim_map.empty())
    write_perceived(tool, a, test, reference, options.layers, report, outputs);
}

}  // namespace vsgl::app
