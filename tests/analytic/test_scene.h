#pragma once

#include <string>

#include "scene/procedural.h"
#include "scene/scene.h"

namespace vsgl::test {

// A scene of scene-gen, written to a folder of its own, loaded back, and removed.
scene::Scene test_scene(const std::string& name, const scene::GenerateOptions& options);

inline scene::Scene test_scene(const std::string& name, int width, int height) {
  scene::GenerateOptions options;
  options.width = width;
  options.height = height;
  return test_scene(name, options);
}

}  // namespace vsgl::test
