// ismap scene.json --lights lights.exr [--gbuffer gbuffer.exr] [--cut cut.exr] -o ism.exr: what sees each
// virtual light.

#include <optional>

#include "base/tool.h"
#include "scene/scene_input.h"
#include "stages/visibility/options.h"

namespace {

struct Arguments {
  vsgl::scene::SceneInput scene;
  std::filesystem::path lights, gbuffer, cut, output;
  vsgl::VisibilityParams params;
};

void declare(vsgl::Tool& tool, Arguments& a) {
  a.scene.declare(tool);
  tool.input("--lights", a.lights, "virtual lights")->required();
  tool.input("--gbuffer", a.gbuffer, "pixels to look from (light trees, and method raytraced)");
  tool.input("--cut", a.cut, "of a light tree: keep its entries");
  tool.output("-o,--output", a.output, "shadow maps, visibility bits or a cut with masks to write")
      ->required();
  vsgl::add_options(tool.app(), a.params);
}

// What `read` makes of the file; nothing without one.
template <class Read>
auto read_optional(vsgl::Report& report, const std::string& kind, const std::filesystem::path& path,
                   Read read) -> std::optional<decltype(read(path))> {
  if (path.empty()) return std::nullopt;
  const vsgl::PhaseTimer timer(report, "read " + kind);
  return read(path);
}

vsgl::Exit run(vsgl::Tool& tool, Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  a.params.seed = tool.common().seed;
  a.params.skip_powerless = !tool.common().no_skip;
  const auto scene = a.scene.read(tool, report);
  const auto lights = read_optional(report, "lights", a.lights, vsgl::read_lights);
  const auto gbuffer = read_optional(report, "gbuffer", a.gbuffer, vsgl::read_gbuffer);
  const auto cut = read_optional(report, "cut", a.cut, vsgl::read_cut);
  const vsgl::VisibilityInputs inputs{.scene = scene,
                                      .lights = *lights,
                                      .gbuffer = gbuffer ? &*gbuffer : nullptr,
                                      .cut = cut ? &*cut : nullptr};
  std::optional<vsgl::gpu::Device> device;
  if (vsgl::choose_visibility(inputs, a.params).method.needs_device) {
    device.emplace(vsgl::gpu::DeviceOptions{
        .device = tool.common().device, .threads = tool.common().threads, .compute_only = true});
    report.count("device", device->info().name);
  }
  const auto visibility = vsgl::build_visibility(inputs, a.params, device ? &*device : nullptr, report);
  const vsgl::PhaseTimer timer(report, "write");
  vsgl::write(outputs.add(a.output), visibility, tool.provenance());
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("ismap", "finds out which pixels see each virtual light, by shadow maps or rays");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
