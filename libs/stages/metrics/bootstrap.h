#pragma once

// How sure a figure of an image is: neighbouring pixels err alike, so blocks of pixels are drawn, not pixels.

#include <cstddef>
#include <functional>
#include <vector>

namespace vsgl::metrics {

// Blocks of 16 x 16 pixels, smaller at the right and lower border.
class Blocks {
 public:
  Blocks(int width, int height);
  std::size_t count() const { return static_cast<std::size_t>(columns_) * rows_; }
  // Of a pixel, counted row by row.
  std::size_t of(std::size_t pixel) const;

 private:
  static constexpr int kSide = 16;
  int width_, columns_, rows_;
};

struct Interval {
  double low = 0, high = 0;
};

// Sums over the pixels of one block; the same number of them for every block.
using Sums = std::vector<double>;

// [Efron 1993, Sec. 13.3] The 95% percentile interval of `statistic`, a function of the sums over all blocks:
// 1000 times as many blocks are drawn as there are, with replacement and a fixed seed. `blocks`: not empty.
Interval bootstrap_interval(const std::vector<Sums>& blocks,
                            const std::function<double(const Sums&)>& statistic);

// The sums over all blocks, in their order.
Sums total(const std::vector<Sums>& blocks);

}  // namespace vsgl::metrics
