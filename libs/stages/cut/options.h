#pragma once

#include "stages/cut/cut.h"

namespace CLI {
class App;
}

namespace vsgl {

// Declares the parameters of this stage as options: the flags of its tool, the keys of its --config file and
// of its object in a pipeline JSON. `params` must outlive the app.
void add_options(CLI::App& app, CutParams& params);

}  // namespace vsgl
