#include "stages/shading/options.h"

#include "base/methods.h"

namespace vsgl {

void add_options(CLI::App& app, ShadingParams& params) {
  add_methods(app, shading_methods(), params.method, "how lights are evaluated");
  app.add_option("--clamp", params.clamp,
                 "vpl: smallest distance, as a fraction of the scene's radius; 0: none")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option(
         "--specular-lobe", params.specular_lobe,
         "auto: the most accurate per normal distribution; asg: anisotropic SG, as the papers print it")
      ->check(CLI::IsMember({"auto", "asg"}));
  app.add_option("--cbr", params.cbr, "consistent bias reduction: threshold of the sharpness ratio; 0: off")
      ->check(CLI::Range(0.0, 1.0));
}

}  // namespace vsgl
