#include "reference/options.h"

#include <CLI/CLI.hpp>

namespace vsgl::reference {

void add_options(CLI::App& app, ReferenceParams& params) {
  app.add_option("--strategy", params.strategy,
                 "where paths start: light, at the sources; brdf, at the camera; mis, both, weighted")
      ->check(CLI::IsMember({"light", "brdf", "mis"}));
  app.add_option("--samples", params.samples,
                 "paths a pixel and kind of path (with --target-error or --time-budget: as many as it takes, "
                 "unless this is given)")
      ->check(CLI::Range(1, kMaxSamples));
  app.add_option("--target-error", params.target_error,
                 "stop when sqrt(mean variance) / mean of the indirect light is below")
      ->check(CLI::PositiveNumber);
  app.add_option("--time-budget", params.time_budget_s,
                 "stop after the pass during which so many seconds end")
      ->check(CLI::PositiveNumber);
}

void add_options(CLI::App& app, EnvironmentParams& params) {
  app.add_option(
         "--blockers", params.blockers,
         "environment: what hides and reflects its light: scene; meshes: those that proxies stand for; "
         "spheres: the proxies themselves")
      ->check(CLI::IsMember({"scene", "meshes", "spheres"}));
  app.add_option("--bounce", params.bounce,
                 "environment: light on what reflects it: shadowed, or unshadowed as proxy-gi has it")
      ->check(CLI::IsMember({"shadowed", "unshadowed"}));
}

}  // namespace vsgl::reference
