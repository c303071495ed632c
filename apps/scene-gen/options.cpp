#include "options.h"

namespace vsgl::scene_gen {
namespace {

std::string list_of_scenes() {
  std::string text;
  for (const auto& [name, summary] : scene::generators()) {
    if (!text.empty()) text += '\n';
    text += name + std::string(16 - name.size(), ' ');
    text += summary;
  }
  return text;
}

}  // namespace

void declare(Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  std::vector<std::string> names;
  for (const auto& info : scene::generators()) names.push_back(info.name);
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

}  // namespace vsgl::scene_gen
