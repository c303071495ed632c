#pragma once

#include <functional>

#include "scene/procedural.h"
#include "scene/procedural/model.h"

namespace vsgl::scene {

// One function a scene; each in the file of its name.
Model make_cornell(const GenerateOptions& options);
Model make_cornell_glossy(const GenerateOptions& options);
Model make_caustic_ring(const GenerateOptions& options);
Model make_atrium(const GenerateOptions& options);
Model make_thin_walls(const GenerateOptions& options);
Model make_sky(const GenerateOptions& options);
Model make_sphere_light(const GenerateOptions& options);
Model make_figure(const GenerateOptions& options);

// An environment map (OpenEXR) of that radiance, W/(m^2 sr), by directions.
std::string environment_exr(const std::function<Vec3(Vec3)>& radiance);

// The roughness that the options ask for, or `fallback`; and the NDF that goes with it.
struct Lobe {
  double alpha;
  std::string ndf;
};
Lobe chosen_lobe(const GenerateOptions& options, double fallback);

}  // namespace vsgl::scene
