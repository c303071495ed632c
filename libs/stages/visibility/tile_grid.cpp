#include "stages/visibility/tile_grid.h"

#include <algorithm>
#include <bit>

#include "cluster/continuity.h"

namespace vsgl::visibility {
namespace {

constexpr std::uint32_t kSpacing = 5;  // pixels between samples
constexpr std::uint32_t kCells = 3;    // a side, between four samples
// Corner 2 j + i of cell (x, y) is this sample.
std::uint32_t corner_sample(std::uint32_t cell_x, std::uint32_t cell_y, std::uint32_t corner) {
  return 4 * (cell_y + corner / 2) + cell_x + corner % 2;
}

// Bit c: of the sample at corner c of a cell.
std::uint32_t corner_bits(std::uint32_t sample_bits, std::uint32_t cell) {
  const std::uint32_t first = corner_sample(cell % kCells, cell / kCells, 0);
  return (sample_bits >> first & 3U) | (sample_bits >> (first + 4) & 3U) << 2;
}

}  // namespace

std::uint32_t TileMask::count() const {
  std::uint32_t sum = 0;
  for (const std::uint32_t word : words) sum += static_cast<std::uint32_t>(std::popcount(word));
  return sum;
}

TileMask& TileMask::operator|=(const TileMask& other) {
  for (std::size_t i = 0; i < words.size(); ++i) words[i] |= other.words[i];
  return *this;
}

TileMask& TileMask::operator&=(const TileMask& other) {
  for (std::size_t i = 0; i < words.size(); ++i) words[i] &= other.words[i];
  return *this;
}

TileMask operator~(TileMask a) {
  for (std::uint32_t& word : a.words) word = ~word;
  return a;
}

TileGrid::TileGrid(const GBuffer& gbuffer, int tile, const TileSamples& samples)
    : width_(static_cast<std::uint32_t>(gbuffer.width)) {
  const auto height = static_cast<std::uint32_t>(gbuffer.height), number = static_cast<std::uint32_t>(tile);
  const std::uint32_t columns = (width_ + interop::TILE - 1) / interop::TILE;
  const std::uint32_t left = number % columns * interop::TILE, top = number / columns * interop::TILE;
  first_ = top * width_ + left;
  for (std::uint32_t y = 0; y < std::min(interop::TILE, height - top); ++y)
    for (std::uint32_t x = 0; x < std::min(interop::TILE, width_ - left); ++x)
      add_pixel(gbuffer, samples, x, y);
}

void TileGrid::add_pixel(const GBuffer& gbuffer, const TileSamples& samples, std::uint32_t x,
                         std::uint32_t y) {
  const std::uint32_t bit = y * interop::TILE + x;
  const interop::Surface& surface = gbuffer.pixels[pixel(bit)];
  if (surface.id == interop::NO_INSTANCE) return;
  surfaces_.set(bit);
  const std::uint32_t cell_x = std::min(x / kSpacing, kCells - 1),
                      cell_y = std::min(y / kSpacing, kCells - 1);
  const double right = static_cast<double>(x - cell_x * kSpacing) / kSpacing,
               down = static_cast<double>(y - cell_y * kSpacing) / kSpacing;
  std::array<double, 4> weights{};
  double sum = 0, matched_tent = 0;
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const std::uint32_t sample = corner_sample(cell_x, cell_y, corner);
    const double tent = (corner % 2 != 0 ? right : 1 - right) * (corner / 2 != 0 ? down : 1 - down);
    if (tent == 0 || (samples.present >> sample & 1U) == 0) continue;
    const double weight = continuity(surface, gbuffer.pixels[samples.pixel[sample]]);
    if (weight < kContinues) continue;
    weights[corner] = tent * weight;
    sum += weights[corner];
    matched_tent += tent;
  }
  if (sum == 0) return;
  matched_.set(bit);
  if (matched_tent < 1 - 1e-6) edges_.set(bit);
  auto& outcomes = outcomes_[cell_y * kCells + cell_x];
  for (std::uint32_t outcome = 0; outcome < outcomes.size(); ++outcome) {
    double visible = 0;
    for (std::uint32_t corner = 0; corner < 4; ++corner)
      if ((outcome >> corner & 1U) != 0) visible += weights[corner];
    if (2 * visible >= sum) outcomes[outcome].set(bit);
  }
}

TileMask TileGrid::interpolate(std::uint32_t sample_bits) const {
  TileMask seen;
  for (std::uint32_t cell = 0; cell < outcomes_.size(); ++cell)
    seen |= outcomes_[cell][corner_bits(sample_bits, cell)];
  return seen;
}

TileMask TileGrid::undecided(std::uint32_t sample_bits) const {
  TileMask pixels;
  for (std::uint32_t cell = 0; cell < outcomes_.size(); ++cell) {
    const std::uint32_t bits = corner_bits(sample_bits, cell);
    if (bits != 0 && bits != 15) pixels |= outcomes_[cell][15];
  }
  return pixels;
}

}  // namespace vsgl::visibility
