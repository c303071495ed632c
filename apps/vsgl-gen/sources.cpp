#include "sources.h"

#include <optional>

#include "scene/scene.h"

namespace vsgl::vsgl_gen {
namespace {

template <class Read>
auto timed(Report& report, const char* phase, Read read, const auto& from) {
  const PhaseTimer timer(report, phase);
  return read(from);
}

Chains read_chains(const std::filesystem::path& path) {
  Chains chains = read_lights(path).chains;
  if (chains.states.empty())
    throw Error(ErrorCode::missing_part,
                path.string() + ": has no chains to go on; make it with --method metropolis");
  return chains;
}

}  // namespace

Generated from_rsm(const Arguments& a, gpu::Device* device, Report& report) {
  const Rsm rsm = timed(report, "read rsm", read_rsm, a.rsm);
  std::optional<Pdf> pdf;
  if (!a.pdf.empty()) pdf = timed(report, "read pdf", read_pdf, a.pdf);
  LightsParams params = a.params;
  Chains previous;
  if (!a.previous.empty()) {
    previous = timed(report, "read previous", read_chains, a.previous);
    params.previous = &previous;
  }
  Lights lights = generate_lights(rsm, pdf ? &*pdf : nullptr, params, device, report);
  auto info = describe(lights, rsm, params, a.dump);
  return {std::move(lights), std::move(info)};
}

Generated from_environment(const Arguments& a, gpu::Device& device, Report& report) {
  scene::EnvironmentSpec spec = a.environment;
  spec.rotation_deg = {a.rotation_deg[0], a.rotation_deg[1], a.rotation_deg[2]};
  const auto map = timed(report, "read environment", scene::read_environment, spec);
  Lights lights = generate_environment_lights(map, a.params, device, report);
  auto info = describe(lights, map, a.params, a.dump);
  return {std::move(lights), std::move(info)};
}

Generated from_sphere_lights(Tool& tool, const Arguments& a, Report& report) {
  const auto read = [](const auto& path) { return scene::load_scene(path); };
  const scene::Scene scene = timed(report, "read scene", read, a.scene);
  for (const auto& file : scene::scene_files(a.scene))
    if (file != a.scene) tool.depends_on(file);
  return {generate_sphere_lights(scene, a.params, report), {}};
}

}  // namespace vsgl::vsgl_gen
