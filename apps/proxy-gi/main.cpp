// proxy-gi --gbuffer gbuffer.exr --proxies proxies.json --environment map.exr -o softgi.exr: soft shadows and
// inter-reflection under an environment.

#include "base/tool.h"
#include "stages/soft_gi/options.h"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path gbuffer, proxies, output, occlusion;
  vsgl::scene::EnvironmentSpec environment;
  std::vector<double> rotation_deg{0, 0, 0};
  vsgl::SoftGiParams params;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  tool.input("--gbuffer", a.gbuffer, "pixels to shade")->required();
  tool.input("--proxies", a.proxies, "spheres of proxy-fit")->required();
  tool.input("--environment", a.environment.file, "latitude-longitude map, OpenEXR or Radiance HDR")
      ->required();
  tool.app()
      .add_option("--environment-rotation", a.rotation_deg,
                  "X,Y,Z: degrees about the world's x, then y, then z")
      ->delimiter(',')
      ->expected(3);
  tool.app()
      .add_option("--environment-scale", a.environment.scale, "factor on the map's values")
      ->check(CLI::Range(0.0, 1e30));
  tool.output("-o,--output", a.output, "radiance to write: direct and indirect")->required();
  tool.output("--occlusion", a.occlusion, "the receivers' occlusion vectors to write");
  vsgl::add_options(tool.app(), a.params);
}

template <class Read>
auto timed(vsgl::Report& report, const char* phase, Read read) {
  const vsgl::PhaseTimer timer(report, phase);
  return read();
}

vsgl::Exit run(const vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  a.environment.rotation_deg = {a.rotation_deg[0], a.rotation_deg[1], a.rotation_deg[2]};
  const auto gbuffer = timed(report, "read gbuffer", [&] { return vsgl::read_gbuffer(a.gbuffer); });
  const auto proxies = timed(report, "read proxies", [&] { return vsgl::read_proxies(a.proxies); });
  const auto environment =
      timed(report, "read environment", [&] { return vsgl::scene::read_environment(a.environment); });
  vsgl::gpu::Device device(
      {.device = tool.common().device, .threads = tool.common().threads, .compute_only = true});
  report.count("device", device.info().name);
  vsgl::Occlusion occlusion;
  const vsgl::Indirect image = vsgl::shade_soft_gi(gbuffer, proxies, environment, a.params, device, report,
                                                   a.occlusion.empty() ? nullptr : &occlusion);
  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), image, tool.provenance());
  if (!a.occlusion.empty()) vsgl::write(outputs.add(a.occlusion), occlusion, tool.provenance());
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("proxy-gi",
                  "shades soft shadows and inter-reflection of sphere proxies under an environment");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
