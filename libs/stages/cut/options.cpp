#include "stages/cut/options.h"

#include <CLI/CLI.hpp>

namespace vsgl {

void add_options(CLI::App& app, CutParams& params) {
  app.add_option("--error", params.error, "RMSE over the mean of the image that the cut may cause")
      ->check(CLI::Range(1e-5, 1.0));
}

}  // namespace vsgl
