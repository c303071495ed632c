// ismap scene.json --lights lights.exr -o ism.exr: a shadow map for each virtual light, all in one atlas.

#include "base/methods.h"
#include "base/tool.h"
#include "stages/visibility/visibility.h"

namespace {

struct Arguments {
  std::filesystem::path scene, lights, output;
  vsgl::VisibilityParams params;
  bool no_pull_push = false;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  tool.input("scene", a.scene, "scene JSON")->required();
  tool.input("--lights", a.lights, "virtual lights that get shadow maps")->required();
  tool.output("-o,--output", a.output, "atlas of shadow maps to write")->required();
  vsgl::add_methods(app, vsgl::visibility_methods(), a.params.method, "how to build the maps");
  app.add_option("--points", a.params.points_per_light, "surface points a light")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--tile", a.params.tile, "texels a side of a map, a power of two")
      ->check(CLI::Range(8, 512));
  app.add_option("--splat-scale", a.params.splat_scale,
                 "radius of a splatted disk, in radii of the disk that a point stands for")
      ->check(CLI::Range(0.0, 4.0));
  app.add_flag("--no-pull-push", a.no_pull_push, "leave the holes between splats open");
}

vsgl::scene::Scene read_scene(vsgl::Tool& tool, const std::filesystem::path& path, vsgl::Report& report) {
  const vsgl::PhaseTimer timer(report, "read scene");
  auto scene = vsgl::scene::load_scene(path);
  for (const auto& file : vsgl::scene::scene_files(path))
    if (file != path) tool.depends_on(file);
  for (const auto& warning : scene.warnings) report.warn(warning);
  return scene;
}

vsgl::Lights read_lights(const std::filesystem::path& path, vsgl::Report& report) {
  const vsgl::PhaseTimer timer(report, "read lights");
  return vsgl::read_lights(path);
}

vsgl::Exit run(vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  a.params.seed = tool.common().seed;
  a.params.pull_push = !a.no_pull_push;
  a.params.skip_powerless = !tool.common().no_skip;
  const auto scene = read_scene(tool, a.scene, report);
  const auto lights = read_lights(a.lights, report);
  vsgl::gpu::Device device(
      {.device = tool.common().device, .threads = tool.common().threads, .compute_only = true});
  report.count("device", device.info().name);
  const auto maps = vsgl::build_shadow_maps(scene, lights, a.params, device, report);
  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), maps, tool.provenance());
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("ismap", "builds shadow maps of all virtual lights");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
