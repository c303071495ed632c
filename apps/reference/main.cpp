// reference scene.json -o reference.exr: ground truth of one-bounce light by ray tracing.

#include "base/log.h"
#include "base/tool.h"
#include "reference/options.h"
#include "reference/sphere_lights.h"
#include "scene/scene_input.h"
#include "stages/rsm/options.h"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  vsgl::scene::SceneInput scene;
  fs::path gbuffer, proxies, output;
  std::string resolution;
  bool sphere_lights = false, environment = false;
  vsgl::reference::ReferenceParams params;
  vsgl::reference::EnvironmentParams environment_params;
};

CLI::Option* declare_environment(vsgl::Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  CLI::Option* environment =
      app.add_flag("--environment", a.environment,
                   "light of the scene's environment, direct and after one bounce, in place of its lights'");
  tool.input("--proxies", a.proxies, "spheres of proxy-fit, for --blockers")->needs(environment);
  vsgl::reference::add_options(app, a.environment_params);
  for (const char* option : {"--blockers", "--bounce"}) app.get_option(option)->needs(environment);
  return environment;
}

void declare(vsgl::Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  a.scene.declare(tool);
  CLI::Option* gbuffer = tool.input("--gbuffer", a.gbuffer,
                                    "pixels of rsm-bake to trace (default: baked here, on a Vulkan device)");
  app.add_option("--resolution", a.resolution,
                 "pixels of the image, WIDTHxHEIGHT (default: the scene's); keeps the vertical field of view")
      ->excludes(gbuffer);
  tool.output("-o,--output", a.output, "radiance and its variance to write")->required();
  vsgl::reference::add_options(app, a.params);
  CLI::Option* spheres =
      app.add_flag("--sphere-lights", a.sphere_lights,
                   "direct light of the scene's sphere lights in place of one-bounce light");
  CLI::Option* environment = declare_environment(tool, a);
  environment->excludes(spheres);
  for (const char* limit : {"--target-error", "--time-budget"})
    app.get_option(limit)->excludes(spheres)->excludes(environment);
  CLI::Option* checkpoint = tool.state(
      "--checkpoint", a.params.checkpoint,
      "file to save the work in and to take it up again from; stays when all is done, for more --samples");
  checkpoint->excludes(spheres)->excludes(environment);
  tool.keep_from_provenance(app.add_option("--checkpoint-interval", a.params.checkpoint_interval_s,
                                           "seconds from one saving to the next")
                                ->check(CLI::NonNegativeNumber));
}

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
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
