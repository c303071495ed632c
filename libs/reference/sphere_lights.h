#pragma once

#include "reference/reference.h"

namespace vsgl::reference {

// Ground truth of the direct light of the scene's sphere lights, with shadows of the scene's surfaces:
// `radiance` and `variance` are of it in place of indirect light, `direct` is zero. Directions are drawn
// uniformly from a sphere's solid angle (strategy light), by the receiver's lobes (brdf), or both, weighted
// by the balance heuristic [Veach 1995] (mis). Takes samples, strategy and seed of `params`. The same bytes
// for any number of threads. Throws bad_value, out_of_range, invalid_data, bad_light.
Reference trace_sphere_lights(const scene::Scene& scene, const GBuffer& gbuffer,
                              const ReferenceParams& params, Report& report);

}  // namespace vsgl::reference
