#include "scene/procedural/generators.h"
#include "scene/procedural/shapes.h"

namespace vsgl::scene {

// [Tokuyoshi 2014s, Fig. 1] A plane of 12 x 16 m with a Phong lobe of exponent 1000, a sphere light of 10 cm
// half a metre above it, and a camera that sees its highlight at a grazing angle. The spot light at the
// sphere's place is for what needs an RSM.
Model make_sphere_light(const GenerateOptions& options) {
  Model model;
  const bool chosen = options.exponent || options.alpha;
  const Lobe lobe = chosen ? chosen_lobe(options, 0) : Lobe{std::sqrt(2 / 1002.0), "phong"};
  const int glossy = model.add_material({.name = "floor",
                                         .base_color = {0.05, 0.05, 0.05},
                                         .specular = {0.6, 0.6, 0.6},
                                         .alpha = lobe.alpha,
                                         .ndf = lobe.ndf});
  Shapes floor("floor", glossy);
  floor.quad({-6, 0, 4}, {6, 0, 4}, {6, 0, -12}, {-6, 0, -12});
  model.add(floor.take());
  model.sphere_light = {{0, 0.5, -3}, 0.1, 100};
  model.camera = {{0, 0.5, 3}, {0, 0.1, -1.5}, 40};
  model.light = {{0, 0.5, -3}, {0, 0, -3}, 60};
  model.light_intensity_w_sr = 1;
  return model;
}

}  // namespace vsgl::scene
