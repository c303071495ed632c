#pragma once

// Visibility: how each virtual light is seen, by shadow maps or by rays. docs/visibility.md states the
// formulas.

#include <cstdint>
#include <string>
#include <vector>

#include "artifact/artifact.h"
#include "base/report.h"
#include "gpu/device.h"
#include "scene/scene.h"

namespace vsgl {

struct VisibilityParams {
  std::string method = "auto";  // a row of visibility_methods()
  int points_per_light = 8192;  // 1..2^20
  int tile = 64;                // texels a side of a light's map, a power of two, 8..512
  double splat_scale = 1.2;  // radius of a splatted disk, in radii of the disk that a point stands for; 0..4
  bool pull_push = true;     // close the holes between splats
  bool skip_powerless = true;  // lights without power get an empty map, or are seen from nowhere
  std::uint64_t seed = 0;      // of points' places inside their triangles, and of ratio's rays
  double error = 0.1;          // of a cut: RMSE over the mean of the image that the user accepts, 1e-5..1
  bool exact = false;          // rays: one for each node of the cut and pixel, nothing interpolated
  int rays = 4;                // ratio: a pixel, 1..64
  int level = -1;  // maps: level of the tree whose nodes get a map; -1: that with about 1024 nodes
};

struct VisibilityInputs {
  const scene::Scene& scene;
  const Lights& lights;
  const GBuffer* gbuffer = nullptr;
  const Cut* cut = nullptr;  // whose entries stay as they are; null: the method chooses a cut
};

// Visibility of all lights: of a list shadow maps or bits, of a tree a cut with masks. The inputs share the
// anchor. `gbuffer` and `device` may be null where the method does not need them (see VisibilityMethod).
// Throws bad_value (method, or one that is not for such lights), missing_option (no G-buffer),
// conflicting_options (a cut that the method does not take), out_of_range (a parameter, or an atlas of more
// than 2^28 texels), wrong_size (cut of another tree or image), invalid_data (a light's normal is not unit,
// or the anchors differ), mesh_invalid (nothing to render).
Visibility build_visibility(const VisibilityInputs& inputs, const VisibilityParams& params,
                            gpu::Device* device, Report& report);

// A way to find out what sees a light. `run` may assume parameters and inputs that build_visibility() has
// checked.
struct VisibilityMethod {
  std::string name;
  std::string summary;  // one line, for --list-methods
  bool for_lists = false;
  bool for_environments = false;  // lists of lights that are infinitely far away
  bool for_trees = false;
  bool needs_gbuffer = false, needs_device = false;
  Visibility (*run)(const VisibilityInputs&, const VisibilityParams&, gpu::Device*, Report&) = nullptr;
};
// The first is `auto`, which stands for one of the others.
const std::vector<VisibilityMethod>& visibility_methods();

// The method that will run, and why where `auto` chooses it. Throws bad_value.
struct VisibilityChoice {
  const VisibilityMethod& method;
  std::string reason;
};
VisibilityChoice choose_visibility(const VisibilityInputs& inputs, const VisibilityParams& params);

}  // namespace vsgl
