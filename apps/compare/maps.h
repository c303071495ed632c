#pragma once

// Maps of where two files differ: --error-map, --false-color, --side-by-side, --flip-map, --ssim-map.

#include "base/tool.h"
#include "stages/metrics/compare.h"

namespace vsgl::app {

struct MapArguments {
  std::filesystem::path error_map, false_colour, side_by_side, flip_map, ssim_map;
  std::string layer, exposure = "auto";
};

void declare_maps(Tool& tool, MapArguments& arguments);

// Writes those that are asked for; one that cannot be made is reported as skipped.
void write_maps(const Tool& tool, const MapArguments& arguments, const ExrFile& test,
                const ExrFile& reference, const metrics::Options& options, Report& report,
                OutputSet& outputs);

}  // namespace vsgl::app
