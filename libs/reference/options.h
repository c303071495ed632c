#pragma once

#include "reference/reference.h"

namespace CLI {
class App;
}

namespace vsgl::reference {

// Declares what shapes the image as options. `params` must outlive the app.
void add_options(CLI::App& app, ReferenceParams& params);

}  // namespace vsgl::reference
