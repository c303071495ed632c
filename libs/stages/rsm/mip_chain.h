#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace vsgl {

// Level l is max(1, width >> l) x max(1, height >> l), the last one 1x1.
int mip_levels(int width, int height);

// All mip levels of a texture, finest first, one RGBA8 word a texel (red in the low byte). Each texel is the
// mean of the 2x2 above it (odd sizes: the last row or column is dropped), taken in linear light. Throws
// texture_unreadable when size and data disagree.
std::vector<std::uint32_t> build_mip_chain(const scene::Texture& texture);

}  // namespace vsgl
