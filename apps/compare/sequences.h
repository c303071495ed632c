#pragma once

// The mode for two sequences of numbered files: how much the first flickers.

#include <optional>
#include <utility>

#include "base/tool.h"
#include "inputs.h"

namespace vsgl::app {

struct SequenceArguments {
  std::optional<std::pair<int, int>> frames;  // first and last
  double frame_rate_hz = 60;
  std::filesystem::path versus;
};

void declare_sequences(Tool& tool, SequenceArguments& arguments);

// Whether both files are sequences. Throws conflicting_options when one is, or when flags of this mode are
// given though none is.
bool are_sequences(Tool& tool, const Inputs& inputs);

// `limits` as in "flicker=0.01". Exit::differs when one is broken or a frame is out of its place.
Exit compare_sequences(Tool& tool, const Inputs& inputs, const SequenceArguments& arguments,
                       const std::string& layer, const std::vector<std::string>& limits, Report& report,
                       OutputSet& outputs);

}  // namespace vsgl::app
