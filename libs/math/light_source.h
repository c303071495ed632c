#pragma once

#include <string>

#include "math/vec.h"

namespace vsgl {

enum class LightType { spot, directional, point };

// A light of the scene as one square (or rectangular) view: what an RSM layer is rendered from. A point light
// gives six, one per cube face. Positions in metres relative to the scene's anchor; `right`, `up`, `forward`
// orthonormal, forward = where it shines.
struct LightSource {
  std::string name;  // of the scene's light
  LightType type = LightType::spot;
  Vec3 position;  // of a directional light: the centre of its near plane
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  double extent_x = 1,
         extent_y = 1;      // tangents of the half angles; directional: half width and height in metres
  Vec3 intensity{1, 1, 1};  // W/sr; directional: W/m^2 on a plane facing it
  double cos_inner = 1, cos_outer = 0;  // spot: full intensity inside the inner cone, none outside the outer
};

// Spot fall-off of KHR_lights_punctual: clamp((cos - cos_outer) / max(1e-3, cos_inner - cos_outer), 0, 1)^2;
// a hard edge when both cones agree; 1 for other types. `cosine`: of the angle to `forward`.
double spot_falloff(const LightSource& light, double cosine);
// Radiant intensity towards a point (W/sr), or irradiance (W/m^2) for a directional light. `to`: unit
// direction from the light.
Vec3 intensity_towards(const LightSource& light, Vec3 to);
// Unit direction from a lit point to the source.
Vec3 direction_to_source(const LightSource& light, Vec3 point);

}  // namespace vsgl
