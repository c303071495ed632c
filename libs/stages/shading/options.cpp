#include "stages/shading/options.h"

#include "base/methods.h"

namespace vsgl {

void add_options(CLI::App& app, ShadingParams& params) {
  add_methods(app, light_models(), params.light_model, "how a light is evaluated", "--light-model");
  app.add_option("--schedule", params.schedule,
                 "which lights a pixel sums: flat: all; interleave: a share, the others from its neighbours; "
                 "cut: those of its tile's cut through a light tree; auto: cut for trees, else flat")
      ->check(CLI::IsMember({"auto", "flat", "interleave", "cut"}));
  app.add_option("--interleave", params.interleave,
                 "interleave: pixels a side of the square that shares the lights; 1: as flat")
      ->check(CLI::IsMember({1, 2, 4, 8}));
  app.add_option("--clamp", params.clamp,
                 "vpl: smallest distance, as a fraction of the scene's radius; 0: none")
      ->check(CLI::Range(0.0, 1.0));
  add_choice(app, "--specular-lobe", specular_lobes(), params.specular_lobe,
             "how a pixel's specular lobe meets a light's");
  app.add_option("--cbr", params.cbr, "consistent bias reduction: threshold of the sharpness ratio; 0: off")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--vsl-samples", params.vsl_samples,
                 "vsl: directions that a technique draws in a hemisphere; narrower cones take fewer")
      ->check(CLI::Range(1, 4096));
  app.add_option("--vsl-cone", params.vsl_cone,
                 "vsl: cone of directions: of a disk that faces the pixel, or of the sphere")
      ->check(CLI::IsMember({"disk", "sphere"}));
  app.add_option("--vsl-techniques", params.vsl_techniques,
                 "vsl: directions drawn from the cone, the receiver's or the light's BRDF; all: balanced")
      ->check(CLI::IsMember({"all", "cone", "receiver", "light"}));
  app.add_option("--diffuse-scale", params.diffuse_scale,
                 "cut: 2: diffuse light at half resolution where that suffices; 1: at every pixel")
      ->check(CLI::IsMember({1, 2}));
}

}  // namespace vsgl
