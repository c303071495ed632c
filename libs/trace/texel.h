#pragma once

#include <array>

#include "scene/scene.h"

namespace vsgl::trace {

// Red, green, blue (linear) and alpha, 0..1.
using Rgba = std::array<double, 4>;

// Textures of a scene, which must outlive it, filtered bilinearly at full resolution: the twin of
// texture_bilinear() of shaders/rsm/texture.glsl at level 0.
class TextureSampler {
 public:
  // Throws texture_unreadable when size and data of a texture disagree.
  explicit TextureSampler(const std::vector<scene::Texture>& textures);

  Rgba bilinear(int texture, double u, double v) const;
  double alpha(int texture, double u, double v) const;

 private:
  const std::vector<scene::Texture>& textures_;
  std::array<double, 256> decoded_;  // of sRGB-encoded bytes
};

}  // namespace vsgl::trace
