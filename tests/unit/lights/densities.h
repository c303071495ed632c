#pragma once

// Four kinds of densities of mean 1, as their mean pyramids.

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "math/sampling.h"

namespace vsgl::test {

struct TestDensity {
  std::string name;
  int size;
  std::vector<float> pyramid;

  DensityPyramid view() const { return {size, pyramid}; }
};

// A hash of the texel in [0, 1).
inline double texel_noise(int i, int j) {
  return pcg3d({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), 7})[0] * 0x1p-32;
}

inline TestDensity make_density(const std::string& name, int size,
                                const std::function<double(int, int)>& value) {
  std::vector<double> values;
  double sum = 0;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      values.push_back(value(i, j));
      sum += values.back();
    }
  std::vector<float> level0;
  for (double v : values) level0.push_back(static_cast<float>(v * size * size / sum));
  return {name, size, mean_pyramid(level0, size)};
}

inline TestDensity smooth_density(int size) {
  return make_density("smooth", size, [size](int i, int j) {
    return 0.2 + std::exp(-8 * (std::pow(i / double(size) - 0.3, 2) + std::pow(j / double(size) - 0.6, 2)));
  });
}
// Contrast 1e4 from texel to texel.
inline TestDensity noisy_density(int size) {
  return make_density("high-frequency", size,
                      [](int i, int j) { return std::pow(10.0, -4 * texel_noise(i, j)); });
}
// 2% of the texels, and empty rows and columns.
inline TestDensity sparse_density(int size) {
  return make_density("sparse", size, [](int i, int j) {
    return i % 16 == 5 || j % 16 == 9 || texel_noise(i, j) > 0.02 ? 0.0 : 1 + 9 * texel_noise(j, i);
  });
}
inline TestDensity caustic_density(int size) {
  return make_density("caustic", size, [size](int i, int j) {
    const double radius = std::hypot(i - 0.4 * size, j - 0.5 * size) / size;
    return 0.01 + 100 * std::exp(-std::pow((radius - 0.25) * 200, 2));
  });
}
inline std::vector<TestDensity> all_densities(int size) {
  return {smooth_density(size), noisy_density(size), sparse_density(size), caustic_density(size)};
}

}  // namespace vsgl::test
