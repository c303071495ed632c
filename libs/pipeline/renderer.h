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

// A frame with everything that led to it.
struct RenderedFrame {
  GBuffer gbuffer;
  Rsm rsm;
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

  gpu::Device& device_;
  Pipeline pipeline_;
  Chains chains_;  // of the last frame's lights
  bool direct_;
  scene::Scene scene_;
  Report report_;               // of the stage that is running
  std::optional<Baker> baker_;  // of scene_
};

}  // namespace vsgl
