#pragma once

#include <vector>

#include "artifact/artifact.h"
#include "scene/sphere_light.h"

namespace vsgl {

// [Tokuyoshi 2014s, A] Sphere lights as a list of lights, one SG each as seen from anywhere: Gaussian
// footprints of variance radius^2 / 4 per axis, the second moment of the disk that a sphere shows, which send
// power 4 pi^2 radius^2 radiance evenly in all directions. `method` is kSphereLights: no surface belongs to
// them, so that `shade` takes them with light model vsgl alone.
inline constexpr const char* kSphereLights = "sphere-lights";
Lights sphere_lights(const std::vector<scene::SphereLight>& spheres, Vec3 anchor, double scene_radius);

}  // namespace vsgl
