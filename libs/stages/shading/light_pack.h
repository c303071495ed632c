#pragma once

#include <vector>

#include "artifact/artifact.h"
#include "interop/shading.h"

namespace vsgl {

// Lights with everything that does not depend on the pixel, in the order of the artifact. Variances are
// floored at (1e-6 scene radius)^2, so that a light in the very place of a pixel stays finite; elsewhere this
// changes nothing.

// At their representative points, for method vpl.
std::vector<interop::ShadingLight> pack_points(const Lights& lights);
// Formulation of 2016: both emission lobes are normalised SGs.
std::vector<interop::ShadingLight> pack_vsgl(const Lights& lights);
// Formulation of 2014: diffuse lobe of sharpness 0, the emitter's cosine outside both lobes.
std::vector<interop::ShadingLight> pack_vsgl_2014(const Lights& lights);
// Of an environment: the diffuse lobe is the SG of radiance, along the light.
std::vector<interop::ShadingLight> pack_environment(const Lights& lights);

}  // namespace vsgl
