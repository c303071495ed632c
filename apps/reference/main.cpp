// reference scene.json -o reference.exr: ground truth of one-bounce light by ray tracing.

#include "base/log.h"
#include "options.h"
#include "reference/sphere_lights.h"
#include "stages/rsm/options.h"

namespace {

using vsgl::reference_tool::Arguments;

vsgl::GBuffer bake(const vsgl::Tool& tool, vsgl::scene::Scene& scene, const std::string& resolution,
                   vsgl::Report& report) {
  if (!resolution.empty()) {
    const auto size = vsgl::read_image_size("--resolution", resolution, vsgl::kMaxResolution);
    scene.camera = vsgl::with_resolution(scene.camera, size.width, size.height);
  }
  vsgl::gpu::Device device({.device = tool.common().device, .threads = tool.common().threads});
  report.count("device", device.info().name);
  return vsgl::bake_gbuffer(scene, device, report);
}

vsgl::Reference trace_environment(const Arguments& a, const vsgl::scene::Scene& scene,
                                  const vsgl::GBuffer& gbuffer, vsgl::Report& report) {
  if (!scene.environment)
    throw vsgl::Error(
        vsgl::ErrorCode::bad_light,
        a.scene.path.string() + ": the scene has no environment; add one under \"environment\"");
  vsgl::reference::EnvironmentParams params = a.environment_params;
  params.samples = a.params.samples;
  params.seed = a.params.seed;
  std::optional<vsgl::Proxies> proxies;
  if (!a.proxies.empty()) proxies = vsgl::read_proxies(a.proxies);
  return vsgl::reference::trace_environment(scene, vsgl::scene::read_environment(*scene.environment),
                                            proxies ? &*proxies : nullptr, gbuffer, params, report);
}

vsgl::Reference trace(const Arguments& a, const vsgl::scene::Scene& scene, const vsgl::GBuffer& gbuffer,
                      vsgl::Report& report) {
  if (a.sphere_lights) return vsgl::reference::trace_sphere_lights(scene, gbuffer, a.params, report);
  if (a.environment) return trace_environment(a, scene, gbuffer, report);
  constexpr std::size_t kSteps = 1000;
  vsgl::Progress bar("reference", kSteps);
  return vsgl::reference::trace_reference(scene, gbuffer, a.params, report, [&](double done) {
    bar.step(static_cast<std::size_t>(done * static_cast<double>(kSteps)));
  });
}

vsgl::Exit run(vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  a.params.seed = tool.common().seed;
  if (tool.app().count("--samples") == 0 && (a.params.target_error || a.params.time_budget_s))
    a.params.samples = vsgl::reference::kMaxSamples;
  vsgl::scene::Scene scene = a.scene.read(tool, report);
  const vsgl::GBuffer gbuffer =
      a.gbuffer.empty() ? bake(tool, scene, a.resolution, report) : vsgl::read_gbuffer(a.gbuffer);
  const vsgl::Reference image = trace(a, scene, gbuffer, report);
  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), image, tool.provenance());
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("reference", "traces ground truth of one-bounce light, with its variance");
  Arguments arguments;
  vsgl::reference_tool::declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
