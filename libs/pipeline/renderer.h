#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/report.h"
#include "gpu/device.h"
#include "pipeline/pipeline.h"
#include "scene/scene.h"

namespace vsgl {

// How one stage went.
struct StageRun {
  std::string tool;   // the tool that runs this stage alone
  double host_s = 0;  // wall time
  Report report;
};

// A frame with everything that led to it; lights and visibility are those of the last pass.
struct RenderedFrame {
  GBuffer gbuffer;
  Rsm rsm;                   // without layers where nothing needs it: the lights are an environment's
  std::optional<Pdf> pdf;  // none: the lights do not follow one
  Lights lights;
  std::optional<Visibility> visibility;  // none: no shadows, and no cut to choose
  Indirect image;
  std::vector<StageRun> stages;     // in the order in which they ran
  std::size_t pipelines_built = 0;  // for this frame
};

// Runs the stages of a pipeline on one device. Between frames it keeps what does not change: compiled
// shaders, geometry and textures. A frame's artifacts are the bytes that the separate tools make, whatever
// was rendered before; but lights by Markov chains go on from the frame before.
class Renderer {
 public:
  // `direct`: the image also holds the light sources' own light. Unless rays are to find
  // what is visible, the device must be able to draw.
  Renderer(gpu::Device& device, Pipeline pipeline, bool direct);
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Throws what the stages throw.
  RenderedFrame render(scene::Scene scene);

 private:
  // Runs one stage and files its report with the frame.
  void run(RenderedFrame& frame, const char* tool, const std::function<void()>& work);
  void take(scene::Scene scene);
  void bake(RenderedFrame& frame);
  LightsSource source() const { return lights_method(pipeline_.vsgl_gen.method).source; }  // of the lights
  void generate(RenderedFrame& frame);
  // Lights, what they see, and the image: the frame's mean of the passes so far.
  void run_pass(RenderedFrame& frame, const Pass& pass);
  const scene::Environment& environment();  // of scene_

  gpu::Device& device_;
  Pipeline pipeline_;
  Chains chains_;  // of the last frame's lights
  bool direct_;
  scene::Scene scene_;
  Report report_;               // of the stage that is running
  std::optional<Baker> baker_;  // of scene_
  std::optional<scene::EnvironmentSpec> environment_spec_;  // of environment_
  scene::Environment environment_;
};

}  // namespace vsgl
