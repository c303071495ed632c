#include "stages/shading/options.h"

#include "base/methods.h"

namespace vsgl {

void add_options(CLI::App& app, ShadingParams& params) {
  add_methods(app, light_models(), params.light_model, "how a light is evaluated", "--light-model");
  app.add_option(
         "--schedule", params.schedule,
         "which lights a pixel sums: flat: all; interleave: a sixteenth, the others from its neighbours; "
         "cut: those of its tile's cut through a light tree; auto: cut for trees, else flat")
      ->check(CLI::IsMember({"auto", "flat", "interleave", "cut"}));
  app.add_option("--clamp", params.clamp,
                 "vpl: smallest distance, as a fraction of the scene's radius; 0: none")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option(
         "--specular-lobe", params.specular_lobe,
         "auto: the most accurate per normal distribution; asg: anisotropic SG, as the papers print it")
      ->check(CLI::IsMember({"auto", "asg"}));
  app.add_option("--cbr", params.cbr, "consistent bias reduction: threshold of the sharpness ratio; 0: off")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--diffuse-scale", params.diffuse_scale,
                 "cut: 2: diffuse light at half resolution where that suffices; 1: at every pixel")
      ->check(CLI::IsMember({1, 2}));
}

}  // namespace vsgl
