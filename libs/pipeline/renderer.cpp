#include "pipeline/renderer.h"

#include <chrono>
#include <utility>

namespace vsgl {

Renderer::Renderer(gpu::Device& device, Pipeline pipeline, bool direct)
    : device_(device), pipeline_(std::move(pipeline)), direct_(direct) {}

void Renderer::run(RenderedFrame& frame, const char* tool, const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  frame.stages.push_back({tool, elapsed.count(), std::exchange(report_, Report())});
}

void Renderer::bake(RenderedFrame& frame) {
  if (baker_)
    baker_->update();
  else
    baker_.emplace(scene_, device_, report_);
  frame.gbuffer = baker_->gbuffer();
  frame.rsm = baker_->rsm(pipeline_.rsm_bake.rsm);
}

RenderedFrame Renderer::render(scene::Scene scene) {
  scene_ = std::move(scene);
  if (const auto size = pipeline_.rsm_bake.resolution)
    scene_.camera = with_resolution(scene_.camera, size->width, size->height);
  RenderedFrame frame;
  const std::size_t built_before = device_.pipelines_built();
  run(frame, "rsm-bake", [&] { bake(frame); });
  if (lights_method(pipeline_.vsgl_gen.method).needs_pdf)
    run(frame, "pdf-build",
        [&] { frame.pdf = build_pdf(frame.rsm, &frame.gbuffer, pipeline_.pdf_build, device_, report_); });
  run(frame, "vsgl-gen", [&] {
    frame.lights =
        generate_lights(frame.rsm, frame.pdf ? &*frame.pdf : nullptr, pipeline_.vsgl_gen, device_, report_);
  });
  if (pipeline_.ismap)
    run(frame, "ismap", [&] {
      frame.visibility =
          build_visibility(scene_, frame.lights, &frame.gbuffer, *pipeline_.ismap, &device_, report_);
    });
  run(frame, "shade", [&] {
    frame.image = shade(frame.gbuffer, frame.lights, frame.visibility ? &*frame.visibility : nullptr,
                        pipeline_.shade, device_, report_);
    if (direct_) shade_direct(frame.gbuffer, frame.rsm, device_, report_, frame.image);
  });
  frame.pipelines_built = device_.pipelines_built() - built_before;
  return frame;
}

}  // namespace vsgl
