#include "cluster/cells.h"

#include <algorithm>
#include <cmath>

#include "math/interop_vec.h"

namespace vsgl {
namespace {

constexpr int kCell = static_cast<int>(interop::TILE) / 4;

// Of the cell that holds the pixel, those that are no background.
TileSamples pixels_around(const GBuffer& gbuffer, std::uint32_t pixel) {
  const int x = static_cast<int>(pixel) % gbuffer.width, y = static_cast<int>(pixel) / gbuffer.width;
  return block_pixels(gbuffer, x / kCell * kCell, y / kCell * kCell);
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
