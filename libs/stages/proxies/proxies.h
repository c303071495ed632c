#pragma once

// Fitting of spheres to a scene's meshes. docs/proxies.md describes the method.

#include <string>
#include <vector>

#include "artifact/proxies.h"
#include "base/report.h"
#include "scene/scene_sequence.h"

namespace vsgl {

struct ProxyParams {
  int count = 16;                        // spheres of a mesh at most, 1..256
  double cover = 0.97;                   // share of a mesh's volume at which no more are added, 0.1..1
  double overlap_cost = 0.5;             // of volume that spheres hold twice, over that of misfit, 0..1
  std::vector<std::string> receivers{};  // instances that only receive light, besides large flat ones
};

// Spheres of all meshes of a frame: fitted once to each mesh in its own coordinates, so that they are the
// same at all frames, and moved with its instances. The same bytes for any number of threads. Throws
// out_of_range, bad_value (a receiver that there is not).
Proxies fit_proxies(const scene::SceneSequence& sequence, int frame, const ProxyParams& params,
                    Report& report);

// The spheres as glTF (.glb), each in its albedo.
std::string proxies_glb(const Proxies& proxies);

}  // namespace vsgl
