#include "cluster/cells.h"

#include <algorithm>
#include <cmath>

#include "math/interop_vec.h"

namespace vsgl {
namespace {

constexpr int kCell = static_cast<int>(interop::TILE) / 4;
static_assert(kCell * kCell == kTileSamples);

// Of the cell that holds the pixel, those that are no background.
TileSamples pixels_around(const GBuffer& gbuffer, std::uint32_t pixel) {
  const int width = gbuffer.width, x0 = static_cast<int>(pixel) % width / kCell * kCell,
            y0 = static_cast<int>(pixel) / width / kCell * kCell;
  TileSamples out;
  for (int k = 0; k < kTileSamples; ++k) {
    const int x = x0 + k % kCell, y = y0 + k / kCell;
    if (x >= width || y >= gbuffer.height) continue;
    const auto i = static_cast<std::uint32_t>(y * width + x);
    if (gbuffer.pixels[i].id == interop::NO_INSTANCE) continue;
    out.pixel[static_cast<std::size_t>(k)] = i;
    out.present |= 1U << k;
  }
  return out;
}

void bound(const SampleReceivers& receivers, Cell& cell) {
  Vec3 centre, half;
  const auto middle = [&](std::size_t axis, double& at, double& extent) {
    const auto [low, high] = std::ranges::minmax(receivers.position[axis].lane);
    at = 0.5 * (static_cast<double>(low) + static_cast<double>(high));
    extent = 0.5 * (static_cast<double>(high) - static_cast<double>(low));
  };
  middle(0, centre.x, half.x);
  middle(1, centre.y, half.y);
  middle(2, centre.z, half.z);
  cell.centre = to_float(centre);
  cell.radius = static_cast<float>(length(half));
}

}  // namespace

std::vector<Cell> cells_of(const GBuffer& gbuffer, const TileSamples& samples) {
  std::vector<Cell> out;
  for (std::size_t k = 0; k < kTileSamples; ++k) {
    if ((samples.present >> k & 1U) == 0) continue;
    Cell& cell = out.emplace_back();
    cell.sample = k;
    cell.receivers = sample_receivers(gbuffer, pixels_around(gbuffer, samples.pixel[k]));
    bound(cell.receivers, cell);
  }
  return out;
}

}  // namespace vsgl
