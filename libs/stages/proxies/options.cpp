#include "stages/proxies/options.h"

#include <CLI/CLI.hpp>

namespace vsgl {

void add_options(CLI::App& app, ProxyParams& params) {
  app.add_option("--count", params.count, "spheres of a mesh at most")->check(CLI::Range(1, 256));
  app.add_option("--cover", params.cover, "share of a mesh's volume at which no more spheres are added")
      ->check(CLI::Range(0.1, 1.0));
  app.add_option("--overlap-cost", params.overlap_cost,
                 "of volume that spheres hold twice, over that of volume missed or outside")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--receivers", params.receivers,
                 "names of nodes that only receive light, besides large flat ones");
}

}  // namespace vsgl
