#pragma once

#include "reference/environment.h"
#include "reference/reference.h"

namespace CLI {
class App;
}

namespace vsgl::reference {

// Declares what shapes the image as options. `params` must outlive the app.
void add_options(CLI::App& app, ReferenceParams& params);
void add_options(CLI::App& app, EnvironmentParams& params);  // besides samples and seed

}  // namespace vsgl::reference
