// vsgl-gen --rsm rsm.exr [--pdf pdf.exr] -o lights.exr [--info lights.json]: virtual lights from a reflective
// shadow map; --environment map.exr in place of --rsm: from an environment map.

#include <optional>

#include "base/tool.h"
#include "scene/scene.h"
#include "stages/lights/options.h"
#include "stages/lights/sphere_lights.h"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path rsm, pdf, previous, spheres, output, info;
  vsgl::scene::EnvironmentSpec environment;
  std::vector<double> rotation_deg{0, 0, 0};
  bool dump = false;
  vsgl::LightsParams params;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  CLI::Option* rsm = tool.input("--rsm", a.rsm, "reflective shadow map to cluster or sample");
  tool.input("--pdf", a.pdf, "density of the samples over its texels (methods that sample)")->needs(rsm);
  tool.input("--previous", a.previous, "lights of the frame before, whose chains go on (method metropolis)")
      ->needs(rsm);
  CLI::Option* map = tool.input("--environment", a.environment.file,
                                "method environment: latitude-longitude map, OpenEXR or Radiance HDR");
  map->excludes(rsm);
  tool.app()
      .add_option("--environment-rotation", a.rotation_deg,
                  "X,Y,Z: degrees about the world's x, then y, then z")
      ->delimiter(',')
      ->expected(3)
      ->needs(map);
  tool.app()
      .add_option("--environment-scale", a.environment.scale, "factor on the map's values")
      ->check(CLI::Range(0.0, 1e30));
  CLI::Option* spheres =
      tool.input("--sphere-lights", a.spheres, "scene JSON whose sphere lights become lights, by no method");
  spheres->excludes(rsm)->excludes(map);
  tool.output("-o,--output", a.output, "lights to write")->required();
  CLI::Option* info = tool.output("--info", a.info, "JSON with statistics of the lights")->excludes(spheres);
  tool.app().add_flag("--dump", a.dump, "list the lights themselves in the JSON")->needs(info);
  vsgl::add_options(tool.app(), a.params);
  vsgl::add_pass_options(tool.app(), a.params.pass);
}

struct Generated {
  vsgl::Lights lights;
  nlohmann::ordered_json info;
};

template <class Read>
auto timed(vsgl::Report& report, const char* phase, Read read, const auto& from) {
  const vsgl::PhaseTimer timer(report, phase);
  return read(from);
}

Generated from_environment(Arguments& a, vsgl::gpu::Device& device, vsgl::Report& report) {
  a.environment.rotation_deg = {a.rotation_deg[0], a.rotation_deg[1], a.rotation_deg[2]};
  const auto map = timed(report, "read environment", vsgl::scene::read_environment, a.environment);
  Generated out{vsgl::generate_environment_lights(map, a.params, device, report), {}};
  out.info = describe(out.lights, map, a.params, a.dump);
  return out;
}

vsgl::Chains read_chains(const fs::path& path) {
  vsgl::Chains chains = vsgl::read_lights(path).chains;
  if (chains.states.empty())
    throw vsgl::Error(vsgl::ErrorCode::missing_part,
                      path.string() + ": has no chains to go on; make it with --method metropolis");
  return chains;
}

Generated from_rsm(Arguments& a, vsgl::gpu::Device* device, vsgl::Report& report) {
  const vsgl::Rsm rsm = timed(report, "read rsm", vsgl::read_rsm, a.rsm);
  std::optional<vsgl::Pdf> pdf;
  if (!a.pdf.empty()) pdf = timed(report, "read pdf", vsgl::read_pdf, a.pdf);
  vsgl::Chains previous;
  if (!a.previous.empty()) {
    previous = timed(report, "read previous", read_chains, a.previous);
    a.params.previous = &previous;
  }
  Generated out{vsgl::generate_lights(rsm, pdf ? &*pdf : nullptr, a.params, device, report), {}};
  out.info = describe(out.lights, rsm, a.params, a.dump);
  return out;
}

vsgl::Lights from_sphere_lights(vsgl::Tool& tool, const Arguments& a, vsgl::Report& report) {
  const vsgl::PhaseTimer timer(report, "read scene");
  for (const auto& file : vsgl::scene::scene_files(a.spheres))
    if (file != a.spheres) tool.depends_on(file);
  const vsgl::scene::Scene scene = vsgl::scene::load_scene(a.spheres);
  const auto spheres = vsgl::scene::load_sphere_lights(a.spheres, scene.anchor);
  report.count("lights", spheres.size());
  return vsgl::sphere_lights(spheres, scene.anchor, scene.radius);
}

vsgl::Exit run(vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  if (!a.spheres.empty()) {
    vsgl::write(outputs.add(a.output), from_sphere_lights(tool, a, report), tool.provenance());
    return vsgl::Exit::ok;
  }
  if (a.rsm.empty() && a.environment.file.empty())
    throw vsgl::Error(vsgl::ErrorCode::missing_option,
                      "--rsm is required; or give --environment with method environment, or --sphere-lights");
  if (a.environment.file.empty() && tool.app().count("--environment-scale") > 0)
    throw vsgl::Error(vsgl::ErrorCode::missing_option, "--environment-scale requires --environment");
  a.params.seed = tool.common().seed;
  std::optional<vsgl::gpu::Device> device;
  if (!a.environment.file.empty() || vsgl::lights_method(a.params.method).needs_device) {
    device.emplace(vsgl::gpu::DeviceOptions{
        .device = tool.common().device, .threads = tool.common().threads, .compute_only = true});
    report.count("device", device->info().name);
  }
  const Generated out =
      a.rsm.empty() ? from_environment(a, *device, report) : from_rsm(a, device ? &*device : nullptr, report);
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
