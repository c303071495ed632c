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
  std::string method = "ism";   // a row of visibility_methods()
  int points_per_light = 8192;  // 1..2^20
  int tile = 64;                // texels a side of a light's map, a power of two, 8..512
  double splat_scale = 1.2;  // radius of a splatted disk, in radii of the disk that a point stands for; 0..4
  bool pull_push = true;     // close the holes between splats
  bool skip_powerless = true;  // lights without power get an empty map, or are seen from nowhere
  std::uint64_t seed = 0;      // of the points' places inside their triangles
};

// Visibility of all lights. `scene`, `lights` and `gbuffer` share the anchor. `gbuffer` and `device` may be
// null where the method does not need them (see VisibilityMethod). Throws bad_value (method), missing_option
// (no G-buffer), out_of_range (a parameter, or an atlas of more than 2^28 texels), invalid_data (a light's
// normal is not unit, or the anchors differ), mesh_invalid (nothing to render).
Visibility build_visibility(const scene::Scene& scene, const Lights& lights, const GBuffer* gbuffer,
                            const VisibilityParams& params, gpu::Device* device, Report& report);

// A way to find out what sees a light. `run` may assume parameters and inputs that build_visibility() has
// checked.
struct VisibilityMethod {
  std::string name;
  std::string summary;  // one line, for --list-methods
  bool needs_gbuffer = false, needs_device = false;
  Visibility (*run)(const scene::Scene&, const Lights&, const GBuffer*, const VisibilityParams&, gpu::Device*,
                    Report&);
};
const std::vector<VisibilityMethod>& visibility_methods();
// The row of that name. Throws bad_value, listing those that are there.
const VisibilityMethod& visibility_method(const std::string& name);

}  // namespace vsgl
