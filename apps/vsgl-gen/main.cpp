// vsgl-gen --rsm rsm.exr --pdf pdf.exr -o lights.exr [--info lights.json]: virtual lights from a reflective
// shadow map.

#include "base/methods.h"
#include "base/tool.h"
#include "math/sampling.h"
#include "stages/lights/lights.h"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path rsm, pdf, output, info;
  bool dump = false;
  vsgl::LightsParams params;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  tool.input("--rsm", a.rsm, "reflective shadow map to sample")->required();
  tool.input("--pdf", a.pdf, "density of the samples over its texels")->required();
  tool.output("-o,--output", a.output, "lights to write")->required();
  CLI::Option* info = tool.output("--info", a.info, "JSON with statistics of the lights");
  app.add_flag("--dump", a.dump, "list the lights themselves in the JSON")->needs(info);
  vsgl::add_methods(app, vsgl::lights_methods(), a.params.method, "how lights are made");
  app.add_option("--count", a.params.count, "number of samples")
      ->check(CLI::Range(1, static_cast<int>(vsgl::interop::MAX_POINTS)));
  app.add_option("--kernel-scale", a.params.kernel_scale,
                 "K: a filter kernel holds K / count of the samples; larger is smoother")
      ->check(CLI::PositiveNumber);
  app.add_option("--kernel-solver", a.params.kernel_solver,
                 "fis-2016: newton, exact; bisection, 12 steps as the paper prints it")
      ->check(CLI::IsMember({"newton", "bisection"}));
  app.add_option(
         "--power", a.params.power,
         "fis-2016: conserved, powers add up to the RSM's; paper, as printed, without the common factor")
      ->check(CLI::IsMember({"conserved", "paper"}));
  app.add_option("--points", a.params.points,
                 "sample points: lattice of a searched generator, fibonacci, or random")
      ->check(CLI::IsMember(vsgl::point_set_names()));
}

vsgl::Exit run(const vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  const auto read = [&](const char* phase, auto reader, const fs::path& path) {
    const vsgl::PhaseTimer timer(report, phase);
    return reader(path);
  };
  const vsgl::Rsm rsm = read("read rsm", vsgl::read_rsm, a.rsm);
  const vsgl::Pdf pdf = read("read pdf", vsgl::read_pdf, a.pdf);
  a.params.seed = tool.common().seed;

  vsgl::gpu::Device device(
      {.device = tool.common().device, .threads = tool.common().threads, .compute_only = true});
  report.count("device", device.info().name);
  const vsgl::Lights lights = vsgl::generate_lights(rsm, pdf, a.params, device, report);

  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), lights, tool.provenance());
  if (!a.info.empty())
    vsgl::write_text(outputs.add(a.info), describe(lights, rsm, a.params, a.dump).dump(2) + "\n");
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("vsgl-gen", "samples and filters virtual lights from a reflective shadow map");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
