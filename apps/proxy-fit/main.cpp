// proxy-fit scene.json -o proxies.json: spheres that stand for the scene's meshes.

#include "base/tool.h"
#include "scene/scene_input.h"
#include "stages/proxies/options.h"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  vsgl::scene::SceneInput scene;
  fs::path output, glb;
  vsgl::ProxyParams params;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  a.scene.declare(tool);
  tool.output("-o,--output", a.output, "spheres to write, as JSON")->required();
  tool.output("--glb", a.glb, "the same spheres as glTF to write, to look at");
  vsgl::add_options(tool.app(), a.params);
}

vsgl::scene::SceneSequence read(vsgl::Tool& tool, const vsgl::scene::SceneInput& input,
                                vsgl::Report& report) {
  const vsgl::PhaseTimer timer(report, "read scene");
  vsgl::scene::SceneSequence sequence(input.path);
  for (const fs::path& file : vsgl::scene::scene_files(input.path))
    if (file != input.path) tool.depends_on(file);
  return sequence;
}

vsgl::Exit run(vsgl::Tool& tool, const Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  const vsgl::scene::SceneSequence sequence = read(tool, a.scene, report);
  const vsgl::Proxies proxies = vsgl::fit_proxies(sequence, a.scene.frame, a.params, report);
  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), proxies, tool.provenance());
  if (!a.glb.empty()) vsgl::write_text(outputs.add(a.glb), vsgl::proxies_glb(proxies));
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("proxy-fit", "fits spheres to the meshes of a scene");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
