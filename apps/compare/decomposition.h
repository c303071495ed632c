#pragma once

// The mode for a chain of images: which cause has which part of the error.

#include <string>
#include <vector>

#include "base/tool.h"
#include "inputs.h"

namespace vsgl::app {

struct DecompositionArguments {
  std::vector<std::string> steps;  // CAUSE=FILE[,FILE...]
  std::string remainder = "discretisation", weights = "absolute";
};

void declare_decomposition(Tool& tool, DecompositionArguments& arguments);

// Whether there are steps. Throws conflicting_options when flags of this mode are given and there are none.
bool is_decomposition(Tool& tool, const DecompositionArguments& arguments);

// `limits`: at most one, "remainder=0.02". Exit::differs when more is left than it, or without one than
// noise.
Exit decompose_error(Tool& tool, const Inputs& inputs, const DecompositionArguments& arguments,
                     const std::string& layer, const std::vector<std::string>& limits, Report& report,
                     OutputSet& outputs);

}  // namespace vsgl::app
