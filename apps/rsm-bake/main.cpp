// rsm-bake scene.json --gbuffer gbuffer.exr --rsm rsm.exr: what the camera sees, and what the lights see.

#include "base/tool.h"
#include "scene/scene_input.h"
#include "stages/rsm/options.h"

namespace {

struct Arguments {
  vsgl::scene::SceneInput scene;
  std::filesystem::path gbuffer, rsm;
  vsgl::BakeParams params;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  a.scene.declare(tool);
  tool.output("--gbuffer", a.gbuffer, "G-buffer of the camera to write");
  tool.output("--rsm", a.rsm, "reflective shadow map of the lights to write");
  vsgl::add_options(tool.app(), a.params);
}

vsgl::Exit run(vsgl::Tool& tool, const Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  if (a.gbuffer.empty() && a.rsm.empty()) {
    throw vsgl::Error(vsgl::ErrorCode::missing_option, "nothing to do: give --gbuffer, --rsm or both");
  }
  auto scene = a.scene.read(tool, report);
  if (const auto size = a.params.resolution)
    scene.camera = vsgl::with_resolution(scene.camera, size->width, size->height);
  vsgl::gpu::Device device({.device = tool.common().device,
                            .threads = tool.common().threads,
                            .compute_only = a.params.compute_only()});
  report.count("device", device.info().name);
  vsgl::Baker baker(scene, device, report, a.params.visible);
  if (!a.gbuffer.empty()) {
    const vsgl::GBuffer gbuffer = baker.gbuffer();
    const vsgl::PhaseTimer timer(report, "write gbuffer");
    vsgl::write(outputs.add(a.gbuffer), gbuffer, tool.provenance());
  }
  if (!a.rsm.empty()) {
    const vsgl::Rsm rsm = baker.rsm(a.params.rsm);
    const vsgl::PhaseTimer timer(report, "write rsm");
    vsgl::write(outputs.add(a.rsm), rsm, tool.provenance());
  }
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("rsm-bake", "rasterises G-buffer and reflective shadow maps of a scene");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
