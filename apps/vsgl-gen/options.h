#pragma once

#include "base/tool.h"
#include "scene/environment.h"
#include "stages/lights/lights.h"

namespace vsgl::vsgl_gen {

struct Arguments {
  std::filesystem::path rsm, pdf, previous, scene, output, info;
  scene::EnvironmentSpec environment;
  std::vector<double> rotation_deg{0, 0, 0};  // of the environment
  bool dump = false;
  LightsParams params;

  // The one that is given. Throws missing_option without any.
  LightsSource source() const;
};

void declare(Tool& tool, Arguments& a);

}  // namespace vsgl::vsgl_gen
