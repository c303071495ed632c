#include "stages/soft_gi/options.h"

#include "base/methods.h"

namespace vsgl {

void add_options(CLI::App& app, SoftGiParams& params) {
  app.add_option("--rate", params.rate, "pixels a side that one receiver stands for")
      ->check(CLI::IsMember({1, 2, 4, 8}));
  add_choice(app, "--emission", emissions(), params.emission, "radiance of a lit proxy");
  add_choice(app, "--exponential", exponentials(), params.exponential, "exponential of summed logarithms");
  add_choice(app, "--upsample", upsamplers(), params.upsample, "pixels between receivers");
  add_choice(app, "--normalisation", normalisations(), params.normalisation, "light of proxies that overlap");
  add_choice(app, "--overlap", overlaps(), params.overlap, "how much of each proxy counts");
  app.add_option("--shadow-influence", params.shadow_influence,
                 "reach of a proxy's shadow, in its radii (default: chosen for the environment)")
      ->check(CLI::Range(1.0, 1000.0));
  app.add_option("--indirect-influence", params.indirect_influence,
                 "reach of a proxy's light, in its radii (default: chosen for the environment)")
      ->check(CLI::Range(1.0, 1000.0));
  app.add_option("--tolerance", params.tolerance,
                 "change of shade that a proxy may cause beyond its reach, over the largest irradiance")
      ->check(CLI::Range(1e-5, 0.5));
}

}  // namespace vsgl
