#pragma once

// Grids of numbers and separable filters on them.

#include <cstddef>
#include <vector>

namespace vsgl::metrics {

// Row by row from the top-left.
struct Grid {
  int width = 0, height = 0;
  std::vector<double> values;

  Grid() = default;
  Grid(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  double* row(int y) { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  const double* row(int y) const {
    return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

// Taps of a filter in one direction, an odd number, the centre in the middle.
using Kernel = std::vector<double>;

// exp(-x^2 / (2 sigma^2)) at x = -radius..radius, scaled to the sum 1. `sigma` in pixels, > 0.
Kernel gaussian_kernel(double sigma, int radius);

// The sum over taps and neighbours, horizontal x vertical (a correlation: the kernel is not mirrored). Beyond
// the border the border's values go on. The same bits on any number of threads.
Grid filter(const Grid& grid, const Kernel& horizontal, const Kernel& vertical);

}  // namespace vsgl::metrics
