// rsm-bake scene.json --gbuffer gbuffer.exr --rsm rsm.exr: what the camera sees, and what the lights see.

#include "base/image_size.h"
#include "base/tool.h"
#include "stages/rsm/rsm.h"

namespace {

struct Arguments {
  std::filesystem::path scene, gbuffer, rsm;
  std::string rsm_size = "512", resolution, normals = "consistent";
};

constexpr int kMaxRsm = 4096, kMaxResolution = 16384;

void declare(vsgl::Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  tool.input("scene", a.scene, "scene JSON")->required();
  tool.output("--gbuffer", a.gbuffer, "G-buffer of the camera to write");
  tool.output("--rsm", a.rsm, "reflective shadow map of the lights to write");
  app.add_option("--rsm-size", a.rsm_size, "texels of each RSM layer, N or WIDTHxHEIGHT, 1 to 4096");
  app.add_option(
      "--resolution", a.resolution,
      "pixels of the G-buffer, WIDTHxHEIGHT (default: the scene's); keeps the vertical field of view");
  app.add_option(
         "--rsm-normals", a.normals,
         "what bent normals do to reflected light: consistent with a path tracer, or as in the papers")
      ->check(CLI::IsMember({"consistent", "paper"}));
}

vsgl::scene::Scene read_scene(vsgl::Tool& tool, const std::filesystem::path& path, vsgl::Report& report) {
  const vsgl::PhaseTimer timer(report, "read scene");
  auto scene = vsgl::scene::load_scene(path);
  for (const auto& file : vsgl::scene::scene_files(path))
    if (file != path) tool.depends_on(file);
  for (const auto& warning : scene.warnings) report.warn(warning);
  return scene;
}

vsgl::RsmParams rsm_params(const Arguments& a) {
  const vsgl::ImageSize size = vsgl::read_image_size("--rsm-size", a.rsm_size, kMaxRsm);
  return {size.width, size.height,
          a.normals == "paper" ? vsgl::NormalConvention::paper : vsgl::NormalConvention::consistent};
}

vsgl::Exit run(vsgl::Tool& tool, const Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  if (a.gbuffer.empty() && a.rsm.empty()) {
    throw vsgl::Error(vsgl::ErrorCode::missing_option, "nothing to do: give --gbuffer, --rsm or both");
  }
  const vsgl::RsmParams params = rsm_params(a);
  auto scene = read_scene(tool, a.scene, report);
  if (!a.resolution.empty()) {
    const vsgl::ImageSize size = vsgl::read_image_size("--resolution", a.resolution, kMaxResolution);
    scene.camera = vsgl::with_resolution(scene.camera, size.width, size.height);
  }
  vsgl::gpu::Device device({.device = tool.common().device, .threads = tool.common().threads});
  report.count("device", device.info().name);
  vsgl::Baker baker(scene, device, report);
  if (!a.gbuffer.empty()) {
    const vsgl::GBuffer gbuffer = baker.gbuffer();
    const vsgl::PhaseTimer timer(report, "write gbuffer");
    vsgl::write(outputs.add(a.gbuffer), gbuffer, tool.provenance());
  }
  if (!a.rsm.empty()) {
    const vsgl::Rsm rsm = baker.rsm(params);
    const vsgl::PhaseTimer timer(report, "write rsm");
    vsgl::write(outputs.add(a.rsm), rsm, tool.provenance());
  }
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("rsm-bake", "rasterises G-buffer and reflective shadow maps of a scene");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
