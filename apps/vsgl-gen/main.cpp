// vsgl-gen --rsm rsm.exr [--pdf pdf.exr] -o lights.exr [--info lights.json]: virtual lights from a reflective
// shadow map.

#include <optional>

#include "base/tool.h"
#include "stages/lights/options.h"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path rsm, pdf, previous, output, info;
  bool dump = false;
  vsgl::LightsParams params;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  tool.input("--rsm", a.rsm, "reflective shadow map to cluster or sample")->required();
  tool.input("--pdf", a.pdf, "density of the samples over its texels (methods that sample)");
  tool.input("--previous", a.previous, "lights of the frame before, whose chains go on (method metropolis)");
  tool.output("-o,--output", a.output, "lights to write")->required();
  CLI::Option* info = tool.output("--info", a.info, "JSON with statistics of the lights");
  tool.app().add_flag("--dump", a.dump, "list the lights themselves in the JSON")->needs(info);
  vsgl::add_options(tool.app(), a.params);
}

vsgl::Chains read_chains(const fs::path& path) {
  vsgl::Chains chains = vsgl::read_lights(path).chains;
  if (chains.states.empty())
    throw vsgl::Error(vsgl::ErrorCode::missing_part,
                      path.string() + ": has no chains to go on; make it with --method metropolis");
  return chains;
}

vsgl::Exit run(const vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  const auto read = [&](const char* phase, auto reader, const fs::path& path) {
    const vsgl::PhaseTimer timer(report, phase);
    return reader(path);
  };
  const vsgl::Rsm rsm = read("read rsm", vsgl::read_rsm, a.rsm);
  std::optional<vsgl::Pdf> pdf;
  if (!a.pdf.empty()) pdf = read("read pdf", vsgl::read_pdf, a.pdf);
  vsgl::Chains previous;
  if (!a.previous.empty()) a.params.previous = &(previous = read("read previous", read_chains, a.previous));
  a.params.seed = tool.common().seed;

  std::optional<vsgl::gpu::Device> device;
  if (vsgl::lights_method(a.params.method).needs_device) {
    device.emplace(vsgl::gpu::DeviceOptions{
        .device = tool.common().device, .threads = tool.common().threads, .compute_only = true});
    report.count("device", device->info().name);
  }
  const vsgl::Lights lights =
      vsgl::generate_lights(rsm, pdf ? &*pdf : nullptr, a.params, device ? &*device : nullptr, report);

  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), lights, tool.provenance());
  if (!a.info.empty())
    vsgl::write_text(outputs.add(a.info), describe(lights, rsm, a.params, a.dump).dump(2) + "\n");
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("vsgl-gen", "virtual lights, or a tree of them, from a reflective shadow map");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
