#include "stages/visibility/share_filter.h"

#include <algorithm>
#include <cstdlib>

#include "cluster/continuity.h"

namespace vsgl::visibility {
namespace {

// Weights fall linearly to 0 at that many pixels.
constexpr int kReach = 4;

double tent(int offset) {
  return 1 - static_cast<double>(std::abs(offset)) / kReach;
}

float filter(const GBuffer& gbuffer, std::span<const float> shares, int x, int y) {
  const auto index = [&](int column, int row) {
    return static_cast<std::size_t>(row * gbuffer.width + column);
  };
  const interop::Surface& pixel = gbuffer.pixels[index(x, y)];
  if (pixel.id == interop::NO_INSTANCE) return 1;
  double sum = 0, weights = 0;
  for (int row = std::max(y - kReach + 1, 0); row < std::min(y + kReach, gbuffer.height); ++row)
    for (int column = std::max(x - kReach + 1, 0); column < std::min(x + kReach, gbuffer.width); ++column) {
      const std::size_t i = index(column, row);
      if (shares[i] == kNoShare) continue;
      const double surface = continuity(pixel, gbuffer.pixels[i]);
      if (surface < kContinues) continue;
      const double weight = tent(column - x) * tent(row - y) * surface;
      sum += weight * static_cast<double>(shares[i]);
      weights += weight;
    }
  return weights > 0 ? static_cast<float>(sum / weights) : 1;
}

}  // namespace

std::vector<float> filter_shares(const GBuffer& gbuffer, std::span<const float> shares) {
  std::vector<float> out(gbuffer.pixels.size());
#pragma omp parallel for schedule(dynamic)
  for (int y = 0; y < gbuffer.height; ++y)
    for (int x = 0; x < gbuffer.width; ++x)
      out[static_cast<std::size_t>(y * gbuffer.width + x)] = filter(gbuffer, shares, x, y);
  return out;
}

}  // namespace vsgl::visibility
