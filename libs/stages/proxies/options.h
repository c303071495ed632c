#pragma once

#include "stages/proxies/proxies.h"

namespace CLI {
class App;
}

namespace vsgl {

// Declares the parameters of this stage as options. `params` must outlive the app.
void add_options(CLI::App& app, ProxyParams& params);

}  // namespace vsgl
