#pragma once

#include <string>

#include "artifact/proxies.h"
#include "reference/reference.h"
#include "scene/environment.h"

namespace vsgl::reference {

struct EnvironmentParams {
  int samples = 256;  // paths a pixel, 1..2^24; rounded up to whole passes
  std::uint64_t seed = 0;
  std::string blockers =
      "scene";  // what hides and reflects light: scene: all of it; meshes: those that the proxies stand for;
                // spheres: the proxies themselves, by a receiver's rules for self-shadowing
  std::string bounce =
      "shadowed";  // light on what reflects it: shadowed; unshadowed: as if nothing else were there
};

// Ground truth of an environment's light with diffuse reflection alone: `direct` is what arrives unhindered,
// `diffuse` what one bounce off the blockers adds, `variance` that of `diffuse`. By paths from the camera,
// directions drawn by the cosine. The same bytes for any number of threads. `proxies`: null, unless the
// blockers need them. Throws bad_value, out_of_range, invalid_data.
Reference trace_environment(const scene::Scene& scene, const scene::Environment& environment,
                            const Proxies* proxies, const GBuffer& gbuffer, const EnvironmentParams& params,
                            Report& report);

}  // namespace vsgl::reference
