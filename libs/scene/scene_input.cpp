#include "scene/scene_input.h"

namespace vsgl::scene {

void SceneInput::declare(Tool& tool) {
  tool.input("scene", path, "scene JSON")->required();
  tool.app()
      .add_option("--frame", frame, "frame of an animated scene, from 0")
      ->check(CLI::NonNegativeNumber);
}

Scene SceneInput::read(Tool& tool, Report& report) const {
  const PhaseTimer timer(report, "read scene");
  Scene scene = load_scene(path, frame);
  for (const auto& file : scene_files(path))
    if (file != path) tool.depends_on(file);
  for (const auto& warning : scene.warnings) report.warn(warning);
  return scene;
}

}  // namespace vsgl::scene
