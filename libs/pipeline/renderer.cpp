#include "pipeline/renderer.h"

#include <chrono>
#include <utility>

#include "base/error.h"
#include "stages/shading/accumulate.h"

namespace vsgl {
namespace {

bool same_surfaces(const scene::Scene& a, const scene::Scene& b) {
  return a.anchor == b.anchor && a.radius == b.radius && a.instances == b.instances &&
         a.materials == b.materials && a.textures == b.textures;
}

}  // namespace

Renderer::Renderer(gpu::Device& device, Pipeline pipeline, bool direct)
    : device_(device), pipeline_(std::move(pipeline)), direct_(direct) {}

void Renderer::run(RenderedFrame& frame, const char* tool, const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  frame.stages.push_back({tool, elapsed.count(), std::exchange(report_, Report())});
}

// What the baker has made of surfaces that stay stays with it.
void Renderer::take(scene::Scene scene) {
  if (baker_ && same_surfaces(scene, scene_)) {
    scene_.camera = scene.camera;
    scene_.environment = scene.environment;
    scene_.sphere_lights = std::move(scene.sphere_lights);
    scene_.lights = std::move(scene.lights);
  } else {
    scene_ = std::move(scene);
    if (baker_) baker_->update();
  }
  if (const auto size = pipeline_.rsm_bake.resolution)
    scene_.camera = with_resolution(scene_.camera, size->width, size->height);
  if (!baker_) baker_.emplace(scene_, device_, report_, pipeline_.rsm_bake.visible);
}

void Renderer::bake(RenderedFrame& frame) {
  frame.gbuffer = baker_->gbuffer();
  if (source() == LightsSource::rsm || direct_) frame.rsm = baker_->rsm(pipeline_.rsm_bake.rsm);
}

const scene::Environment& Renderer::environment() {
  if (!scene_.environment)
    throw Error(ErrorCode::missing_option,
                "environment: method environment needs one; give the scene a map, \"environment\": "
                "{\"file\": \"map.exr\"}");
  if (environment_spec_ != scene_.environment) {
    const PhaseTimer timer(report_, "read environment");
    environment_ = scene::read_environment(*scene_.environment);
    environment_spec_ = scene_.environment;
  }
  return environment_;
}

void Renderer::generate(RenderedFrame& frame) {
  pipeline_.vsgl_gen.previous = chains_.states.empty() ? nullptr : &chains_;
  frame.lights = [&] {
    switch (source()) {
      case LightsSource::environment:
        return generate_environment_lights(environment(), pipeline_.vsgl_gen, device_, report_);
      case LightsSource::sphere_lights:
        return generate_sphere_lights(scene_, pipeline_.vsgl_gen, report_);
      case LightsSource::rsm:
        break;
    }
    return generate_lights(frame.rsm, frame.pdf ? &*frame.pdf : nullptr, pipeline_.vsgl_gen, &device_,
                           report_);
  }();
  chains_ = frame.lights.chains;
}

void Renderer::run_pass(RenderedFrame& frame, const Pass& pass) {
  pipeline_.vsgl_gen.pass = pipeline_.shade.pass = pass;
  run(frame, "vsgl-gen", [&] { generate(frame); });
  if (pipeline_.ismap)
    run(frame, "ismap", [&] {
      frame.visibility =
          build_visibility({scene_, frame.lights, &frame.gbuffer}, *pipeline_.ismap, &device_, report_);
    });
  else if (frame.lights.is_tree())
    run(frame, "light-cut",
        [&] { frame.visibility = build_cut(frame.gbuffer, frame.lights, pipeline_.light_cut, report_); });
  run(frame, "shade", [&] {
    Indirect image = shade(frame.gbuffer, frame.lights, frame.visibility ? &*frame.visibility : nullptr,
                           pipeline_.shade, device_, report_);
    if (direct_) shade_direct(frame.gbuffer, frame.rsm, device_, report_, image);
    frame.image =
        pass.number == 1 ? std::move(image) : accumulate(std::move(frame.image), image, pass.number);
  });
}

RenderedFrame Renderer::render(scene::Scene scene) {
  RenderedFrame frame;
  const std::size_t built_before = device_.pipelines_built();
  run(frame, "rsm-bake", [&] {
    take(std::move(scene));
    bake(frame);
  });
  if (lights_method(pipeline_.vsgl_gen.method).needs_pdf)
    run(frame, "pdf-build",
        [&] { frame.pdf = build_pdf(frame.rsm, &frame.gbuffer, pipeline_.pdf_build, device_, report_); });
  const Progressive progressive = pipeline_.progressive.value_or(Progressive{.passes = 1});
  for (int number = 1; number <= progressive.passes; ++number) run_pass(frame, {number, progressive.alpha});
  frame.pipelines_built = device_.pipelines_built() - built_before;
  return frame;
}

}  // namespace vsgl
