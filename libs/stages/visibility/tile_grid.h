#pragma once

// The pixels of a tile between the samples on which its cut was decided.

#include <array>
#include <cstdint>
#include <vector>

#include "artifact/artifact.h"
#include "cluster/traverse.h"

namespace vsgl::visibility {

// A bit for each pixel of a tile: bit y TILE + x is pixel (x, y).
struct TileMask {
  std::array<std::uint32_t, interop::MASK_WORDS> words{};

  void set(std::uint32_t bit) { words[bit / 32] |= 1U << (bit % 32); }
  bool test(std::uint32_t bit) const { return (words[bit / 32] >> (bit % 32) & 1U) != 0; }
  bool none() const { return *this == TileMask{}; }
  std::uint32_t count() const;

  TileMask& operator|=(const TileMask& other);
  TileMask& operator&=(const TileMask& other);
  friend TileMask operator~(TileMask a);
  friend TileMask operator|(TileMask a, const TileMask& b) { return a |= b; }
  friend TileMask operator&(TileMask a, const TileMask& b) { return a &= b; }
  friend bool operator==(const TileMask&, const TileMask&) = default;
};

// Visibility at the samples becomes that of all pixels: that of the four samples at the corners of a pixel's
// cell, each weighted by its distance in the image (a tent) and by how well its surface continues the
// pixel's (distance from its plane, angle between the geometric normals). A pixel whose surface no corner
// continues is unmatched.
class TileGrid {
 public:
  TileGrid(const GBuffer& gbuffer, int tile, const TileSamples& samples);

  // Matched pixels whose interpolated visibility is at least 1/2. `sample_bits`: which samples see.
  TileMask interpolate(std::uint32_t sample_bits) const;

  // Matched pixels of the cells whose corners do not all have the same bit.
  TileMask undecided(std::uint32_t sample_bits) const;

  const TileMask& surfaces() const { return surfaces_; }  // pixels that are no background
  const TileMask& matched() const { return matched_; }
  // Matched pixels some of whose corners are unmatched: visibility is not interpolated but extended.
  const TileMask& edges() const { return edges_; }
  TileMask unmatched() const { return surfaces_ & ~matched_; }
  // Index of a pixel of the tile in the image.
  std::uint32_t pixel(std::uint32_t bit) const {
    return first_ + bit / interop::TILE * width_ + bit % interop::TILE;
  }

 private:
  void add_pixel(const GBuffer& gbuffer, const TileSamples& samples, std::uint32_t x, std::uint32_t y);

  std::uint32_t first_, width_;
  TileMask surfaces_, matched_, edges_;
  // Of each cell, for each of the 16 outcomes at its corners: the pixels that see.
  std::array<std::array<TileMask, 16>, 9> outcomes_{};
};

}  // namespace vsgl::visibility
