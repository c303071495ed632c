#pragma once

#include "stages/soft_gi/soft_gi.h"

namespace CLI {
class App;
}

namespace vsgl {

// Declares the parameters of this stage as options. `params` must outlive the app.
void add_options(CLI::App& app, SoftGiParams& params);

}  // namespace vsgl
