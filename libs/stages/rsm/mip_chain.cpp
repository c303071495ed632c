#include "stages/rsm/mip_chain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/srgb.h"

namespace vsgl {
namespace {

using Texel = std::array<float, 4>;

struct Level {
  int width, height;
  std::vector<Texel> texels;  // linear, 0..1

  const Texel& at(int x, int y) const {
    const int column = std::min(x, width - 1), row = std::min(y, height - 1);
    return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
};

Level decode(const scene::Texture& texture) {
  std::array<std::array<float, 256>, 2> tables;  // as it is, and sRGB
  for (int i = 0; i < 256; ++i) {
    const float value = static_cast<float>(i) / 255;
    tables[0][i] = value;
    tables[1][i] = srgb_decode(value);
  }
  Level level{texture.width, texture.height, std::vector<Texel>(texture.rgba.size() / 4)};
  for (std::size_t i = 0; i < texture.rgba.size(); ++i) {
    const bool encoded = texture.srgb && i % 4 != 3;
    level.texels[i / 4][i % 4] = tables[encoded ? 1 : 0][texture.rgba[i]];
  }
  return level;
}

Level halve(const Level& fine) {
  Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) {
      Texel mean;
      for (std::size_t c = 0; c < 4; ++c) {
        mean[c] = 0.25f * (fine.at(2 * x, 2 * y)[c] + fine.at(2 * x + 1, 2 * y)[c] +
                           fine.at(2 * x, 2 * y + 1)[c] + fine.at(2 * x + 1, 2 * y + 1)[c]);
      }
      coarse.texels.push_back(mean);
    }
  }
  return coarse;
}

void append_encoded(const Level& level, bool srgb, std::vector<std::uint32_t>& out) {
  for (const Texel& texel : level.texels) {
    std::uint32_t word = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const float value = srgb && c != 3 ? srgb_encode(texel[c]) : texel[c];
      word |= static_cast<std::uint32_t>(std::lround(255 * value)) << (8 * c);
    }
    out.push_back(word);
  }
}

}  // namespace

int mip_levels(int width, int height) {
  int levels = 1;
  while (std::max(width, height) >> levels > 0) ++levels;
  return levels;
}

std::vector<std::uint32_t> build_mip_chain(const scene::Texture& texture) {
  texture.require_whole();
  std::vector<std::uint32_t> words;
  Level level = decode(texture);
  append_encoded(level, texture.srgb, words);
  for (int i = 1; i < mip_levels(texture.width, texture.height); ++i) {
    level = halve(level);
    append_encoded(level, texture.srgb, words);
  }
  return words;
}

}  // namespace vsgl
