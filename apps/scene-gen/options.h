#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/tool.h"
#include "scene/procedural.h"

namespace vsgl::scene_gen {

struct Arguments {
  std::string name;
  std::filesystem::path output;
  std::vector<double> offset{0, 0, 0};  // m
  std::string resolution;               // WxH; empty: the scene's own
  scene::GenerateOptions options;
};

void declare(Tool& tool, Arguments& a);

}  // namespace vsgl::scene_gen
