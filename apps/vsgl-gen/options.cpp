#include "options.h"

#include "stages/lights/options.h"

namespace vsgl::vsgl_gen {
namespace {

CLI::Option* declare_rsm(Tool& tool, Arguments& a) {
  CLI::Option* rsm = tool.input("--rsm", a.rsm, "reflective shadow map to cluster or sample");
  tool.input("--pdf", a.pdf, "density of the samples over its texels (methods that sample)")->needs(rsm);
  tool.input("--previous", a.previous, "lights of the frame before, whose chains go on (method metropolis)")
      ->needs(rsm);
  return rsm;
}

CLI::Option* declare_environment(Tool& tool, Arguments& a) {
  CLI::Option* map = tool.input("--environment", a.environment.file,
                                "method environment: latitude-longitude map, OpenEXR or Radiance HDR");
  tool.app()
      .add_option("--environment-rotation", a.rotation_deg,
                  "X,Y,Z: degrees about the world's x, then y, then z")
      ->delimiter(',')
      ->expected(3)
      ->needs(map);
  tool.app()
      .add_option("--environment-scale", a.environment.scale, "factor on the map's values")
      ->check(CLI::Range(0.0, 1e30));
  return map;
}

}  // namespace

LightsSource Arguments::source() const {
  if (!rsm.empty()) return LightsSource::rsm;
  if (!environment.file.empty()) return LightsSource::environment;
  if (!scene.empty()) return LightsSource::sphere_lights;
  throw Error(
      ErrorCode::missing_option,
      "--rsm is required; or give --environment with method environment, or --sphere-lights with method "
      "sphere-lights");
}

void declare(Tool& tool, Arguments& a) {
  CLI::Option* rsm = declare_rsm(tool, a);
  CLI::Option* map = declare_environment(tool, a)->excludes(rsm);
  CLI::Option* spheres =
      tool.input("--sphere-lights", a.scene, "method sphere-lights: scene JSON that has some");
  spheres->excludes(rsm)->excludes(map);
  tool.output("-o,--output", a.output, "lights to write")->required();
  CLI::Option* info = tool.output("--info", a.info, "JSON with statistics of the lights")->excludes(spheres);
  tool.app().add_flag("--dump", a.dump, "list the lights themselves in the JSON")->needs(info);
  add_options(tool.app(), a.params);
  add_pass_options(tool.app(), a.params.pass);
}

}  // namespace vsgl::vsgl_gen
