#pragma once

// Visibility: a shadow map for each virtual light. docs/visibility.md states the formulas.

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
  bool skip_powerless = true;  // lights without power get an empty map
  std::uint64_t seed = 0;      // of the points' places inside their triangles
};

// Shadow maps of all lights, seen from each over the hemisphere of its mean normal. `lights` and `scene`
// share the anchor. Throws bad_value (method), out_of_range (a parameter, or an atlas of more than 2^28
// texels), invalid_data (a light's normal is not unit, or scene and lights have different anchors),
// mesh_invalid (nothing to render).
ShadowMaps build_shadow_maps(const scene::Scene& scene, const Lights& lights, const VisibilityParams& params,
                             gpu::Device& device, Report& report);

// A way to build shadow maps. `run` may assume parameters and inputs that build_shadow_maps() has checked,
// and at least one light.
struct VisibilityMethod {
  std::string name;
  std::string summary;  // one line, for --list-methods
  ShadowMaps (*run)(const scene::Scene&, const Lights&, const VisibilityParams&, gpu::Device&, Report&);
};
const std::vector<VisibilityMethod>& visibility_methods();

}  // namespace vsgl
