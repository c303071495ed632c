#include "base/pass.h"

#include <CLI/CLI.hpp>

#include "base/error.h"

namespace vsgl {

void add_pass_options(CLI::App& app, Pass& pass) {
  app.add_option("--pass", pass.number, "pass of progressive rendering: other points, smaller lights")
      ->check(CLI::Range(1, max_passes));
  app.add_option(
         "--pass-alpha", pass.alpha,
         "how slowly lights shrink from pass to pass, 0 to 1: variance falls as passes^-alpha, bias as "
         "passes^(alpha - 1)")
      ->check(CLI::Range(0.0, 1.0));
}

void check_pass(const Pass& pass) {
  if (pass.number < 1 || pass.number > max_passes)
    throw Error(ErrorCode::out_of_range,
                "pass: " + std::to_string(pass.number) + " is outside 1.." + std::to_string(max_passes));
  if (!(pass.alpha >= 0 && pass.alpha <= 1))
    throw Error(ErrorCode::out_of_range, "pass_alpha: " + std::to_string(pass.alpha) +
                                             " is outside 0..1; 0.6667 balances noise and bias");
}

}  // namespace vsgl
