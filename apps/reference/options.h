#pragma once

#include "base/tool.h"
#include "reference/options.h"
#include "scene/scene_input.h"

namespace vsgl::reference_tool {

// What the command line of `reference` says.
struct Arguments {
  scene::SceneInput scene;
  std::filesystem::path gbuffer, proxies, output;
  std::string resolution;
  bool sphere_lights = false, environment = false;
  reference::ReferenceParams params;
  reference::EnvironmentParams environment_params;
};

// Declares the options of `reference`, which fill `a` when the tool parses them.
void declare(Tool& tool, Arguments& a);

}  // namespace vsgl::reference_tool
