#pragma once

#include <string>

#include "artifact/artifact.h"
#include "scene/scene.h"

namespace vsgl::reference {

// A hash of everything that the light in the image depends on, textures included; not of names.
std::string fingerprint(const scene::Scene& scene, const GBuffer& gbuffer);

}  // namespace vsgl::reference
