#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vsgl::reference {

// Distributions over the cells of the unit square that light paths start from, one for each tile of the
// image.
class Guide {
 public:
  static constexpr int kSide = 64;  // cells a side
  static constexpr int kCells = kSide * kSide;

  // Uniform until set() is called.
  explicit Guide(std::size_t tiles = 0);

  // `weights`: importance of each cell, >= 0. A part of the probability is always uniform, so that no light
  // is lost.
  void set(std::size_t tile, std::span<const double, kCells> weights);

  // A uniform point of the unit square, warped to the tile's distribution.
  std::array<double, 2> warp(std::size_t tile, std::array<double, 2> u) const;
  // Density of warp() at a point.
  double density(std::size_t tile, std::array<double, 2> u) const;

  // The point x, y (0..1 each) of a cell.
  static std::array<double, 2> point_in(int cell, double x, double y);

 private:
  // Upper bounds of cumulative probability: of the rows, then within each row.
  using Table = std::array<float, kSide + kCells>;

  std::span<const float, kSide> columns(std::size_t tile, int row) const;

  std::vector<Table> tables_;
};

}  // namespace vsgl::reference
