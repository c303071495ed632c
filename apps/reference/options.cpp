#include "options.h"

namespace vsgl::reference_tool {
namespace {

CLI::Option* declare_environment(Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  CLI::Option* environment =
      app.add_flag("--environment", a.environment,
                   "light of the scene's environment, direct and after one bounce, in place of its lights'");
  tool.input("--proxies", a.proxies, "spheres of proxy-fit, for --blockers")->needs(environment);
  reference::add_options(app, a.environment_params);
  for (const char* option : {"--blockers", "--bounce"}) app.get_option(option)->needs(environment);
  return environment;
}

}  // namespace

void declare(Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  a.scene.declare(tool);
  CLI::Option* gbuffer = tool.input("--gbuffer", a.gbuffer,
                                    "pixels of rsm-bake to trace (default: baked here, on a Vulkan device)");
  app.add_option("--resolution", a.resolution,
                 "pixels of the image, WIDTHxHEIGHT (default: the scene's); keeps the vertical field of view")
      ->excludes(gbuffer);
  tool.output("-o,--output", a.output, "radiance and its variance to write")->required();
  reference::add_options(app, a.params);
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

}  // namespace vsgl::reference_tool
