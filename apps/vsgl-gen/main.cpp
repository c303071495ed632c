// vsgl-gen --rsm rsm.exr [--pdf pdf.exr] -o lights.exr [--info lights.json]: virtual lights from a reflective
// shadow map; in the place of --rsm: --environment map.exr, from an environment map, or --sphere-lights
// scene.json, the scene's sphere lights.

#include <optional>

#include "sources.h"

namespace {

using vsgl::LightsSource;
using vsgl::vsgl_gen::Arguments;
using vsgl::vsgl_gen::Generated;

Generated generate(vsgl::Tool& tool, const Arguments& a, vsgl::Report& report) {
  const LightsSource source = a.source();
  std::optional<vsgl::gpu::Device> device;
  if (source == LightsSource::environment || vsgl::lights_method(a.params.method).needs_device) {
    device.emplace(vsgl::gpu::DeviceOptions{
        .device = tool.common().device, .threads = tool.common().threads, .compute_only = true});
    report.count("device", device->info().name);
  }
  if (source == LightsSource::environment) return from_environment(a, *device, report);
  if (source == LightsSource::sphere_lights) return from_sphere_lights(tool, a, report);
  return from_rsm(a, device ? &*device : nullptr, report);
}

vsgl::Exit run(vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  if (a.environment.file.empty() && tool.app().count("--environment-scale") > 0)
    throw vsgl::Error(vsgl::ErrorCode::missing_option, "--environment-scale requires --environment");
  a.params.seed = tool.common().seed;
  const Generated out = generate(tool, a, report);
  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), out.lights, tool.provenance());
  if (!a.info.empty()) vsgl::write_text(outputs.add(a.info), out.info.dump(2) + "\n");
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("vsgl-gen",
                  "virtual lights, or a tree of them, from a reflective shadow map or an environment map");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
