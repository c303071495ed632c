#pragma once

// Synthetic input of the shading benchmark and tests: the inside of a box, lit by virtual lights on its walls.

#include "artifact/artifact.h"

namespace vsgl::bench {

struct SceneOptions {
  int width = 64, height = 36, lights = 64;
  std::uint32_t receiver_ndf = 0;  // NDF_* of every pixel
  std::uint32_t emission_ndf = 0;  // NDF_* of every light
  float alpha = 0.2f;
};

GBuffer make_gbuffer(const SceneOptions& options);
Lights make_lights(const SceneOptions& options);

}  // namespace vsgl::bench
