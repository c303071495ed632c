#pragma once

#include <span>
#include <vector>

#include "artifact/artifact.h"
#include "base/report.h"
#include "gpu/device.h"
#include "interop/moments.h"
#include "math/sampling.h"

namespace vsgl {

// The G-buffer as a reflective shadow map whose light is the camera: every pixel receives a flux of 1. Square
// cells of pixels, padded to a power of two a side.
struct ImageMoments {
  int size = 0;                           // cells a side
  std::vector<interop::Moments> moments;  // of the cells, row by row; with mipmaps of all levels
  std::vector<float> density;  // mean pyramid of the cells' weights, of mean 1; empty where nothing reflects
};

// `mipmapped`: with the other levels of the moments.
ImageMoments image_moments(const GBuffer& gbuffer, bool mipmapped, gpu::Device& device, Report& report);

}  // namespace vsgl
