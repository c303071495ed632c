#pragma once

// The mode for two files: channel by channel, with thresholds, metrics and maps.

#include <optional>

#include "base/tool.h"
#include "inputs.h"
#include "maps.h"
#include "stages/metrics/flip.h"

namespace vsgl::app {

struct FilesArguments {
  double threshold = 0, fail_percent = 0;
  std::optional<double> hard_limit, relmse_epsilon;
  std::vector<std::string> limits, metrics, channels, exclude;
  int seam_tile = 0;
  bool allow_non_finite = false, z_test = false;
  double significance = 0.05, flip_ppd = metrics::kFlipPixelsPerDegree;
  std::string flip_mode = "hdr";
  MapArguments maps;
};

void declare_files(Tool& tool, FilesArguments& arguments);

// Exit::differs when the comparison fails.
Exit compare_files(Tool& tool, const Inputs& inputs, const FilesArguments& arguments, Report& report,
                   OutputSet& outputs);

}  // namespace vsgl::app
