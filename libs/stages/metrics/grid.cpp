#include "stages/metrics/grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vsgl::metrics {
namespace {

Grid filter_rows(const Grid& grid, const Kernel& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  Grid out(grid.width, grid.height);
#pragma omp parallel
  {
    std::vector<double> padded(static_cast<std::size_t>(grid.width + 2 * radius));
#pragma omp for schedule(static)
    for (int y = 0; y < grid.height; ++y) {
      const double* in = grid.row(y);
      for (int x = -radius; x < grid.width + radius; ++x)
        padded[static_cast<std::size_t>(x + radius)] = in[std::clamp(x, 0, grid.width - 1)];
      double* result = out.row(y);
      for (std::size_t k = 0; k < kernel.size(); ++k)
        for (int x = 0; x < grid.width; ++x) result[x] += kernel[k] * padded[static_cast<std::size_t>(x) + k];
    }
  }
  return out;
}

Grid filter_columns(const Grid& grid, const Kernel& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  Grid out(grid.width, grid.height);
#pragma omp parallel for schedule(static)
  for (int y = 0; y < grid.height; ++y) {
    double* result = out.row(y);
    for (int k = -radius; k <= radius; ++k) {
      const double weight = kernel[static_cast<std::size_t>(k + radius)];
      const double* in = grid.row(std::clamp(y + k, 0, grid.height - 1));
      for (int x = 0; x < grid.width; ++x) result[x] += weight * in[x];
    }
  }
  return out;
}

}  // namespace

Kernel gaussian_kernel(double sigma, int radius) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(std::exp(-0.5 * x * x / (sigma * sigma)));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& tap : kernel) tap /= sum;
  return kernel;
}

Grid filter(const Grid& grid, const Kernel& horizontal, const Kernel& vertical) {
  return filter_columns(filter_rows(grid, horizontal), vertical);
}

}  // namespace vsgl::metrics
