#pragma once

#include <optional>
#include <string>
#include <vector>

#include "artifact/artifact.h"
#include "gpu/device.h"
#include "scene/scene.h"
#include "stages/visibility/visibility.h"

namespace vsgl::test {

// A scene, what the camera sees of it, and the tree of its lit texels.
struct TreeScene {
  TreeScene(const std::string& name, std::optional<double> alpha, int width, int height, int rsm_size);

  // The default chain's image within a relative error. `visibility`: method, exact; its error is replaced.
  Indirect cut_image(double error, VisibilityParams visibility) const;
  // Every lit texel at every pixel, with a ray each.
  Indirect all_leaves() const;

  scene::Scene scene;
  GBuffer gbuffer;
  Rsm rsm;
  Lights tree;

 private:
  Indirect shade_cut(const Visibility& cut, int diffuse_scale) const;
};

gpu::Device& shared_device();

// Of the light that a pixel sends to the camera, W/(m^2 sr).
double indirect_luminance(const Indirect& image, std::size_t pixel);

}  // namespace vsgl::test
