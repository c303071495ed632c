// scene-gen NAME -o FOLDER/NAME.json: writes a test scene as a scene JSON and, beside it, a .glb and
// textures.

#include "base/image_size.h"
#include "base/tool.h"
#include "scene/procedural.h"

namespace {

struct Arguments {
  std::string name;
  std::filesystem::path output;
  vsgl::scene::GenerateOptions options;
  std::vector<double> offset{0, 0, 0};
  std::string resolution;
};

std::string list_of_scenes() {
  std::string text;
  for (const auto& [name, summary] : vsgl::scene::generators()) {
    if (!text.empty()) text += '\n';
    text += name + std::string(16 - name.size(), ' ');
    text += summary;
  }
  return text;
}

void declare(vsgl::Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  std::vector<std::string> names;
  for (const auto& info : vsgl::scene::generators()) names.push_back(info.name);
  app.add_option("scene", a.name, "which scene to make; see --list-scenes")
      ->required()
      ->check(CLI::IsMember(names));
  tool.output("-o,--output", a.output, "scene JSON to write; the .glb and the textures go beside it")
      ->required();
  app.add_option("--offset", a.offset, "X,Y,Z: moves everything, in metres")->delimiter(',')->expected(3);
  app.add_option("--scale", a.options.scale, "scales everything about the origin, before the offset")
      ->check(CLI::Range(1e-6, 1e6))
      ->capture_default_str();
  app.add_option("--resolution", a.resolution, "WxH of the camera's image (default: the scene's own)");
  app.add_option("--alpha", a.options.alpha, "roughness of glossy surfaces (default: the scene's own)")
      ->check(CLI::Range(1e-3, 1.0));
  app.add_option("--ndf", a.options.ndf, "normal distribution of glossy surfaces")
      ->check(CLI::IsMember({"ggx", "beckmann", "phong"}))
      ->capture_default_str();
  app.add_option("--exponent", a.options.exponent, "Phong exponent of glossy surfaces, instead of --alpha")
      ->check(CLI::Range(0.0, 65535.0));
  app.add_option("--triangles", a.options.triangles, "atrium: at most this many")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  app.add_option(
      "--texture-dir", a.options.texture_dir,
      "atrium: folder of glmark2's textures, used in place of made ones (/usr/share/glmark2/textures)");
  tool.input("--mesh", a.options.mesh, "cornell: mesh file that stands in the box in place of the blocks");
  app.add_option("--mesh-material", a.options.mesh_material, "of --mesh: diffuse, glossy or metal")
      ->check(CLI::IsMember({"diffuse", "glossy", "metal"}))
      ->capture_default_str();
  app.add_option("--animate", a.options.animate, "what moves: none, light, camera or object")
      ->check(CLI::IsMember({"none", "light", "camera", "object"}));
  app.add_option("--frames", a.options.frames, "frames of the animation (default: 64)")
      ->check(CLI::Range(2, 10000));
  app.add_flag_callback(
      "--list-scenes", [] { throw CLI::CallForVersion(list_of_scenes(), 0); }, "print the scenes and exit");
}

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
