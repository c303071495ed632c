#pragma once

#include <span>
#include <vector>

#include "artifact/artifact.h"

namespace vsgl::visibility {

// Of a pixel whose share of visible light is not known.
inline constexpr float kNoShare = -1;

// Each pixel's mean of the shares, 0..1, around it: a tent 8 pixels wide, weighted by how well surfaces
// continue the pixel's. Where none is known, and for background: 1. `shares`: a pixel of the G-buffer.
std::vector<float> filter_shares(const GBuffer& gbuffer, std::span<const float> shares);

}  // namespace vsgl::visibility
