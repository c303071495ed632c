#pragma once

// Which flags go with which mode of compare.

#include <string>
#include <vector>

#include "base/tool.h"

namespace vsgl::app {

// Throws conflicting_options when a flag of this tool is given that is not in `allowed` (long names, or names
// of positionals). `mode`: "sequences", for the message.
void allow_only(Tool& tool, const std::string& mode, const std::vector<std::string>& allowed);

// Throws conflicting_options when one of `flags` is given. `need`: what they need, for the message.
void refuse(Tool& tool, const std::vector<std::string>& flags, const std::string& need);

}  // namespace vsgl::app
