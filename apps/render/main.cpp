// render scene.json [--pipeline pipeline.json] -o image.exr: the chain from scene to image in one process.

#include "frame_report.h"
#include "options.h"
#include "pipeline/renderer.h"
#include "scene/scene_sequence.h"

namespace {

using vsgl::render::Arguments;

vsgl::scene::SceneSequence read_scene(vsgl::Tool& tool, const Arguments& a, vsgl::Report& report) {
  const vsgl::PhaseTimer timer(report, "read scene");
  const std::filesystem::path& path = a.scene.path;
  vsgl::scene::SceneSequence sequence(path);
  if (a.last() >= sequence.frames()) {
    throw vsgl::Error(vsgl::ErrorCode::out_of_range, path.string() + ": there is no frame " +
                                                         std::to_string(a.last()) + "; the last one is " +
                                                         std::to_string(sequence.frames() - 1));
  }
  for (const auto& file : vsgl::scene::scene_files(path))
    if (file != path) tool.depends_on(file);
  return sequence;
}

// The images of a sequence are those of their frames alone, headers included.
vsgl::Provenance provenance_of(const vsgl::Tool& tool, int frame) {
  vsgl::Provenance provenance = tool.provenance();
  if (frame > 0) provenance.command_line += " --frame " + std::to_string(frame);
  return provenance;
}

void write_frame(const vsgl::RenderedFrame& frame, const vsgl::render::FramePaths& paths,
                 const vsgl::Provenance& provenance, vsgl::OutputSet& outputs) {
  vsgl::write(outputs.add(paths.image), frame.image, provenance);
  if (paths.gbuffer.empty()) return;
  vsgl::write(outputs.add(paths.gbuffer), frame.gbuffer, provenance);
  if (!frame.rsm.layers.empty()) vsgl::write(outputs.add(paths.rsm), frame.rsm, provenance);
  if (frame.pdf) vsgl::write(outputs.add(paths.pdf), *frame.pdf, provenance);
  vsgl::write(outputs.add(paths.lights), frame.lights, provenance);
  if (frame.visibility) vsgl::write(outputs.add(paths.sight), *frame.visibility, provenance);
}

vsgl::Exit run(vsgl::Tool& tool, const Arguments& a, vsgl::Report& report, vsgl::OutputSet& outputs) {
  const vsgl::Pipeline pipeline = resolve_pipeline(a, tool.common());
  check_outputs(a, pipeline, tool.common().overwrite);
  const vsgl::scene::SceneSequence sequence = read_scene(tool, a, report);
  vsgl::gpu::Device device({.device = tool.common().device,
                            .threads = tool.common().threads,
                            .compute_only = pipeline.rsm_bake.compute_only()});
  report.count("device", device.info().name);
  vsgl::Renderer renderer(device, pipeline, a.direct);
  vsgl::render::FrameReport frames(report);
  for (int number = a.first(); number <= a.last(); ++number) {
    vsgl::scene::Scene scene = [&] {
      const vsgl::PhaseTimer timer(report, "pose scene");
      return sequence.at(number);
    }();
    frames.warn(scene.warnings);
    const vsgl::RenderedFrame frame = renderer.render(std::move(scene));
    frames.add(number, frame);
    const vsgl::PhaseTimer timer(report, "write");
    write_frame(frame, paths_of(number, a, pipeline), provenance_of(tool, number), outputs);
  }
  report.count("pipelines_built", device.pipelines_built());
  frames.finish(tool.common().json);
  return vsgl::Exit::ok;
}

}  // namespace

int main(int argc, char** argv) {
  vsgl::Tool tool("render", "renders a scene: all stages in one process, for one frame or many");
  Arguments arguments;
  declare(tool, arguments);
  return tool.run(argc, argv, [&](vsgl::Report& report, vsgl::OutputSet& outputs) {
    return run(tool, arguments, report, outputs);
  });
}
