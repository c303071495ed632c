#include "stages/metrics/ssim.h"

#include <cmath>

#include "stages/metrics/colour.h"

namespace vsgl::metrics {
namespace {

Grid product(const Grid& a, const Grid& b) {
  Grid out(a.width, a.height);
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] = a.values[i] * b.values[i];
  return out;
}

}  // namespace

Grid ssim(const Grid& test, const Grid& reference, double range) {
  const Kernel window = gaussian_kernel(1.5, 5);
  const auto mean = [&](const Grid& grid) { return filter(grid, window, window); };
  const Grid a = mean(test), b = mean(reference);
  const Grid aa = mean(product(test, test)), bb = mean(product(reference, reference));
  const Grid ab = mean(product(test, reference));
  const double c1 = std::pow(0.01 * range, 2), c2 = std::pow(0.03 * range, 2);
  Grid out(test.width, test.height);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    const double mean_a = a.values[i], mean_b = b.values[i];
    const double variance_a = aa.values[i] - mean_a * mean_a, variance_b = bb.values[i] - mean_b * mean_b;
    const double covariance = ab.values[i] - mean_a * mean_b;
    out.values[i] = (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
                    ((mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2));
  }
  return out;
}

Grid perceived_luminance(const std::vector<Colour>& image, int width, int height, double exposure) {
  const double scale = 100 * std::exp2(exposure);
  Grid out(width, height);
  for (std::size_t i = 0; i < image.size(); ++i) out.values[i] = encode_pu21(scale * luminance_of(image[i]));
  return out;
}

Grid ssim(const LayerPair& layer, double exposure) {
  return ssim(perceived_luminance(layer.test, layer.width, layer.height, exposure),
              perceived_luminance(layer.reference, layer.width, layer.height, exposure), 256);
}

}  // namespace vsgl::metrics
