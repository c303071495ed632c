// shade --gbuffer gbuffer.exr --lights lights.exr [--ism ism.exr | --cut cut.exr] [--rsm rsm.exr]
// -o indirect.exr: radiance per pixel.

#include <optional>

#include "base/tool.h"
#include "stages/cut/options.h"
#include "stages/shading/accumulate.h"
#include "stages/shading/options.h"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path gbuffer, lights, ism, cut, rsm, accumulate, output;
  vsgl::ShadingParams params;
  vsgl::CutParams cut_params;  // of a tree that comes without a cut
};

void declare(vsgl::Tool& tool, Arguments& a) {
  tool.input("--gbuffer", a.gbuffer, "pixels to shade")->required();
  tool.input("--lights", a.lights, "virtual lights")->required();
  CLI::Option* ism =
      tool.input("--ism", a.ism, "what ismap found out about the lights (default: no shadows)");
  CLI::Option* cut = tool.input("--cut", a.cut, "cut of light-cut through a tree (default: chosen here)");
  cut->excludes(ism);
  tool.input("--rsm", a.rsm, "reflective shadow map: adds its direct light as a layer");
  tool.input("--accumulate", a.accumulate, "mean of the passes before this one: writes that of all");
  tool.output("-o,--output", a.output, "radiance to write")->required();
  vsgl::add_options(tool.app(), a.params);
  vsgl::add_pass_options(tool.app(), a.params.pass);
  vsgl::add_options(tool.app(), a.cut_params);
  tool.app().get_option("--error")->excludes(ism)->excludes(cut);  // they have been made for an error
}

vsgl::Exit run(const vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  const auto read = [&](const char* phase, auto reader, const fs::path& path) {
    const vsgl::PhaseTimer timer(report, phase);
    return reader(path);
  };
  const vsgl::GBuffer gbuffer = read("read gbuffer", vsgl::read_gbuffer, a.gbuffer);
  const vsgl::Lights lights = read("read lights", vsgl::read_lights, a.lights);
  std::optional<vsgl::Visibility> visibility;
  if (!a.ism.empty()) visibility = read("read ism", vsgl::read_visibility, a.ism);
  if (!a.cut.empty()) visibility = read("read cut", vsgl::read_cut, a.cut);
  if (!visibility && lights.is_tree()) visibility = vsgl::build_cut(gbuffer, lights, a.cut_params, report);
  a.params.skip = !tool.common().no_skip;
  a.params.seed = tool.common().seed;

  vsgl::gpu::Device device(
      {.device = tool.common().device, .threads = tool.common().threads, .compute_only = true});
  report.count("device", device.info().name);
  vsgl::Indirect image =
      vsgl::shade(gbuffer, lights, visibility ? &*visibility : nullptr, a.params, device, report);
  if (!a.rsm.empty())
    vsgl::shade_direct(gbuffer, read("read rsm", vsgl::read_rsm, a.rsm), device, report, image);
  if (!a.accumulate.empty())
    image = accumulate(read("read mean", vsgl::read_indirect, a.accumulate), image, a.params.pass.number);

  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), image, tool.provenance());
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("shade", "computes indirect radiance per pixel from virtual lights");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
