#pragma once

// What the user asks of render.

#include <filesystem>
#include <optional>
#include <utility>

#include "base/tool.h"
#include "pipeline/pipeline.h"
#include "scene/scene_input.h"

namespace vsgl::render {

struct Arguments {
  scene::SceneInput scene;
  std::filesystem::path pipeline, output, keep;
  std::optional<std::pair<int, int>> frames;  // first and last; none: the scene's one
  bool direct = false;
  std::optional<ImageSize> resolution;
  std::optional<double> error;

  int first() const { return frames ? frames->first : scene.frame; }
  int last() const { return frames ? frames->second : scene.frame; }
};

void declare(Tool& tool, Arguments& a);

// The pipeline JSON with what flags override; the defaults of the tools where none is given.
Pipeline resolve_pipeline(const Arguments& a, const CommonOptions& common);

// Where the artifacts of one frame go; empty for those that are not kept or not made.
struct FramePaths {
  std::filesystem::path image, gbuffer, rsm, pdf, lights, sight;
};
// Throws bad_value where several frames would go to one file.
FramePaths paths_of(int frame, const Arguments& a, const Pipeline& pipeline);
// Checks every output of every frame before work begins, as the frame of the tools does with single files.
void check_outputs(const Arguments& a, const Pipeline& pipeline, bool overwrite);

}  // namespace vsgl::render
