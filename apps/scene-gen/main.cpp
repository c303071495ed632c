// scene-gen NAME -o FOLDER/NAME.json: writes a test scene as a scene JSON and, beside it, a .glb and
// textures.

#include "base/image_size.h"
#include "options.h"

namespace {

using vsgl::scene_gen::Arguments;

vsgl::Exit run(vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  if (a.output.extension() != ".json") {
    throw vsgl::Error(vsgl::ErrorCode::bad_value, "--output " + a.output.string() + ": must end in .json");
  }
  a.options.offset = {a.offset[0], a.offset[1], a.offset[2]};
  a.options.seed = tool.common().seed;
  if (!a.resolution.empty()) {
    const vsgl::ImageSize size = vsgl::read_image_size("--resolution", a.resolution, 16384);
    a.options.width = size.width;
    a.options.height = size.height;
  }
  for (const auto& file : vsgl::scene::referenced_files(a.options)) {
    if (!std::filesystem::is_regular_file(file)) {
      throw vsgl::Error(vsgl::ErrorCode::file_not_found, file.string() + ": the file is missing");
    }
    if (file != a.options.mesh) tool.depends_on(file);
  }
  const vsgl::PhaseTimer timer(report, "generate");
  const std::filesystem::path folder = a.output.parent_path();
  const auto scene = vsgl::scene::generate_scene(a.name, a.options, folder, a.output.stem().string());
  for (const auto& file : scene.files) vsgl::write_text(outputs.add(folder / file.name), file.bytes);
  report.count("triangles", scene.triangles);
  report.count("files", scene.files.size());
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("scene-gen", "writes a test scene: scene JSON, .glb and textures");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
