// pdf-build --rsm rsm.exr [--gbuffer gbuffer.exr] -o pdf.exr: sampling density over the texels of a
// reflective shadow map.

#include <optional>

#include "base/tool.h"
#include "stages/pdf/options.h"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path rsm, gbuffer, output;
  vsgl::PdfParams params;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  tool.input("--rsm", a.rsm, "reflective shadow map")->required();
  tool.input("--gbuffer", a.gbuffer, "image that the light is to reach; the brsm methods need it");
  tool.output("-o,--output", a.output, "density to write")->required();
  vsgl::add_options(tool.app(), a.params);
}

vsgl::Exit run(const vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  const auto read = [&](const char* phase, auto reader, const fs::path& path) {
    const vsgl::PhaseTimer timer(report, phase);
    return reader(path);
  };
  const vsgl::Rsm rsm = read("read rsm", vsgl::read_rsm, a.rsm);
  std::optional<vsgl::GBuffer> gbuffer;
  if (!a.gbuffer.empty()) gbuffer = read("read gbuffer", vsgl::read_gbuffer, a.gbuffer);
  a.params.seed = tool.common().seed;
  a.params.skip = !tool.common().no_skip;

  vsgl::gpu::Device device(
      {.device = tool.common().device, .threads = tool.common().threads, .compute_only = true});
  report.count("device", device.info().name);
  const vsgl::Pdf pdf = vsgl::build_pdf(rsm, gbuffer ? &*gbuffer : nullptr, a.params, device, report);

  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), pdf, tool.provenance());
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("pdf-build", "builds a sampling density over the texels of a reflective shadow map");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
