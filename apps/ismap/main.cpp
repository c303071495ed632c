// ismap scene.json --lights lights.exr [--gbuffer gbuffer.exr] -o ism.exr: what sees each virtual light.

#include <optional>

#include "base/tool.h"
#include "scene/scene_input.h"
#include "stages/visibility/options.h"

namespace {

struct Arguments {
  vsgl::scene::SceneInput scene;
  std::filesystem::path lights, gbuffer, output;
  vsgl::VisibilityParams params;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  a.scene.declare(tool);
  tool.input("--lights", a.lights, "virtual lights")->required();
  tool.input("--gbuffer", a.gbuffer, "pixels to trace rays from (method raytraced)");
  tool.output("-o,--output", a.output, "shadow maps or visibility bits to write")->required();
  vsgl::add_options(tool.app(), a.params);
}

template <class Read>
auto timed(vsgl::Report& report, const char* phase, Read read) {
  const vsgl::PhaseTimer timer(report, phase);
  return read();
}

vsgl::Exit run(vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  a.params.seed = tool.common().seed;
  a.params.skip_powerless = !tool.common().no_skip;
  const auto scene = a.scene.read(tool, report);
  const auto lights = timed(report, "read lights", [&] { return vsgl::read_lights(a.lights); });
  std::optional<vsgl::GBuffer> gbuffer;
  if (!a.gbuffer.empty())
    gbuffer = timed(report, "read gbuffer", [&] { return vsgl::read_gbuffer(a.gbuffer); });
  std::optional<vsgl::gpu::Device> device;
  if (vsgl::visibility_method(a.params.method).needs_device) {
    device.emplace(vsgl::gpu::DeviceOptions{
        .device = tool.common().device, .threads = tool.common().threads, .compute_only = true});
    report.count("device", device->info().name);
  }
  const auto visibility = vsgl::build_visibility(scene, lights, gbuffer ? &*gbuffer : nullptr, a.params,
                                                 device ? &*device : nullptr, report);
  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), visibility, tool.provenance());
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("ismap", "finds out which pixels see each virtual light, by shadow maps or rays");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
