#pragma once

#include <filesystem>

#include "base/tool.h"
#include "scene/scene.h"

namespace vsgl::scene {

// The scene that a tool reads: the positional `scene` and --frame.
struct SceneInput {
  std::filesystem::path path;
  int frame = 0;

  void declare(Tool& tool);
  // Times the phase "read scene", passes on warnings, and takes the files that the scene refers to into the
  // provenance. Throws what load_scene() throws.
  Scene read(Tool& tool, Report& report) const;
};

}  // namespace vsgl::scene
