#pragma once

#include <string>
#include <vector>

#include "interop/geometry.h"
#include "math/light_source.h"
#include "scene/scene.h"

namespace vsgl {

// One view of a light: an RSM layer to be.
struct LightView {
  std::string name;  // "key", or "lamp.px" for a cube face of a point light
  LightSource light;
};

// The scene's lights as views: spots as they are, directional lights framing the scene's bounding sphere,
// point lights as six cube faces px, nx, py, ny, pz, nz. Throws bad_light for a degenerate light or two of
// one name.
std::vector<LightView> light_views(const scene::Scene& scene);

interop::View camera_view(const scene::Camera& camera, double scene_radius);
interop::View light_view(const LightSource& light, double scene_radius, int width, int height);

}  // namespace vsgl
