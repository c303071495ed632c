#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace vsgl {

// All mip levels of a texture, finest first, one RGBA8 word a texel (red in the low byte). Level l is max(1,
// width >> l) x max(1, height >> l): the mean of the 2x2 texels above (odd sizes: the last row or column
// repeated), taken in linear light.
struct MipChain {
  int levels = 0;
  std::vector<std::uint32_t> texels;
};
MipChain build_mip_chain(const scene::Texture& texture);

}  // namespace vsgl
