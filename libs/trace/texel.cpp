#include "trace/texel.h"

#include <cmath>

#include "math/srgb.h"

namespace vsgl::trace {
namespace {

// Remainder in 0..size-1, of negative numbers too.
int wrap(int x, int size) {
  const int r = x % size;
  return r < 0 ? r + size : r;
}

// The four texels about a point of a repeating texture, and their weights.
struct Taps {
  std::array<std::size_t, 4> first;  // byte of the texel's red
  std::array<double, 4> weight;
};

Taps taps_at(const scene::Texture& t, double u, double v) {
  const double x = (u - std::floor(u)) * t.width - 0.5, y = (v - std::floor(v)) * t.height - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j;
  const auto byte = [&](int column, int row) {
    const int index = wrap(row, t.height) * t.width + wrap(column, t.width);
    return 4 * static_cast<std::size_t>(index);
  };
  return {{byte(i, j), byte(i + 1, j), byte(i, j + 1), byte(i + 1, j + 1)},
          {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

}  // namespace

TextureSampler::TextureSampler(const std::vector<scene::Texture>& textures) : textures_(textures) {
  for (const scene::Texture& t : textures) t.require_whole();
  for (std::size_t i = 0; i < decoded_.size(); ++i) decoded_[i] = srgb_decode(static_cast<double>(i) / 255);
}

Rgba TextureSampler::bilinear(int texture, double u, double v) const {
  const scene::Texture& t = textures_[static_cast<std::size_t>(texture)];
  const Taps taps = taps_at(t, u, v);
  Rgba sum{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint8_t* texel = t.rgba.data() + taps.first[k];
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += taps.weight[k] * (t.srgb ? decoded_[texel[c]] : texel[c] / 255.0);
    sum[3] += taps.weight[k] * texel[3] / 255.0;
  }
  return sum;
}

double TextureSampler::alpha(int texture, double u, double v) const {
  const scene::Texture& t = textures_[static_cast<std::size_t>(texture)];
  const Taps taps = taps_at(t, u, v);
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += taps.weight[k] * t.rgba[taps.first[k] + 3] / 255.0;
  return sum;
}

}  // namespace vsgl::trace
