#pragma once

#include <string>

#include "scene/procedural/model.h"

namespace vsgl::scene {

// The bytes of a .glb (glTF 2.0) of the model: one root node that scales by `scale` and then moves by
// `offset`, the meshes, the camera and the spot light (KHR_lights_punctual, candela = 683 W/sr) below it. The
// light's intensity grows with scale^2, so that radiance stays.
std::string write_glb(const Model& model, Vec3 offset, double scale);

}  // namespace vsgl::scene
