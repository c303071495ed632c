#include "stages/metrics/ssim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stages/metrics/colour.h"

namespace vsgl::metrics {
namespace {

Grid grid_of(int width, int height, double (*f)(int x, int y)) {
  Grid out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out.row(y)[x] = f(x, y);
  return out;
}
double waves(int x, int y) {
  return 128 + 60 * std::sin(0.7 * x) * std::cos(0.4 * y) + 10 * ((x * 7 + y * 3) % 5);
}
double other_waves(int x, int y) {
  return waves(x, y) * 0.9 + 15 * std::sin(1.1 * x + y);
}

// [Wang 2004, Eqs. (13) to (16)] at one pixel, with a two-dimensional window and centred moments.
double direct_ssim(const Grid& a, const Grid& b, int px, int py, double range) {
  const auto at = [&](const Grid& g, int x, int y) {
    return g.row(std::clamp(y, 0, g.height - 1))[std::clamp(x, 0, g.width - 1)];
  };
  double total = 0, mean_a = 0, mean_b = 0, var_a = 0, var_b = 0, covariance = 0;
  const auto each = [&](auto f) {
    for (int dy = -5; dy <= 5; ++dy)
      for (int dx = -5; dx <= 5; ++dx)
        f(std::exp(-(dx * dx + dy * dy) / 4.5), at(a, px + dx, py + dy), at(b, px + dx, py + dy));
  };
  each([&](double w, double va, double vb) {
    total += w;
    mean_a += w * va;
    mean_b += w * vb;
  });
  mean_a /= total;
  mean_b /= total;
  each([&](double w, double va, double vb) {
    var_a += w / total * (va - mean_a) * (va - mean_a);
    var_b += w / total * (vb - mean_b) * (vb - mean_b);
    covariance += w / total * (va - mean_a) * (vb - mean_b);
  });
  const double c1 = 1e-4 * range * range, c2 = 9e-4 * range * range;
  const double luminance = (2 * mean_a * mean_b + c1) / (mean_a * mean_a + mean_b * mean_b + c1);
  return luminance * (2 * covariance + c2) / (var_a + var_b + c2);
}

TEST(Ssim, AgreesWithADirectSum) {
  const Grid a = grid_of(23, 17, other_waves), b = grid_of(23, 17, waves), map = ssim(a, b, 255);
  double smallest = 1;
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 23; ++x) {
      EXPECT_NEAR(map.row(y)[x], direct_ssim(a, b, x, y, 255), 1e-11) << x << " " << y;
      smallest = std::min(smallest, map.row(y)[x]);
    }
  EXPECT_LT(smallest, 0.99);  // there was something to see
}

TEST(Ssim, EqualImagesAreOne) {
  const Grid a = grid_of(23, 17, waves);
  for (const double v : ssim(a, a, 255).values) EXPECT_NEAR(v, 1, 1e-12);
}

TEST(Ssim, ConstantsHaveAClosedForm) {
  const Grid a = grid_of(9, 9, [](int, int) { return 50.0; }),
             b = grid_of(9, 9, [](int, int) { return 100.0; });
  const double c1 = 2.55 * 2.55, expected = (2 * 50 * 100 + c1) / (50 * 50 + 100 * 100 + c1);
  for (const double v : ssim(a, b, 255).values) EXPECT_NEAR(v, expected, 1e-10);
}

// A mirrored contrast makes the covariance the negative variance.
TEST(Ssim, InvertedContrastIsNegative) {
  const Grid b = grid_of(32, 32, [](int x, int y) { return 128.0 + ((x + y) % 2 ? 60 : -60); });
  Grid a = b;
  for (double& v : a.values) v = 256 - v;
  EXPECT_LT(ssim(a, b, 255).row(16)[16], -0.95);
}

TEST(Pu21, HundredCandelasAreTheRange) {
  EXPECT_NEAR(encode_pu21(100), 256, 0.5);
  EXPECT_NEAR(encode_pu21(0.005), 0, 1e-3);
  EXPECT_NEAR(encode_pu21(10000), 595.39, 0.01);
  EXPECT_EQ(encode_pu21(-1), encode_pu21(0.005));
  EXPECT_EQ(encode_pu21(1e9), encode_pu21(10000));
  double last = encode_pu21(0.005);
  for (double y = 0.006; y < 9999; y *= 1.2) {
    EXPECT_GT(encode_pu21(y), last);
    last = encode_pu21(y);
  }
}

// Steps of equal ratio look alike in bright and in dark places to within a factor of three, where on a linear
// scale they would differ a thousandfold.
TEST(Ssim, WorksAcrossExposures) {
  LayerPair layer{"indirect", 64, 16, {}, {}};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 64; ++x) {
      const float base = x < 32 ? 1.0f : 0.01f;
      const float b = base * ((x + y) % 2 ? 1.2f : 1.0f);
      layer.reference.push_back({b, b, b});
      layer.test.push_back({base * 1.1f, base * 1.1f, base * 1.1f});  // the pattern is lost
    }
  const Grid map = ssim(layer, 0);
  EXPECT_LT(map.row(8)[12], 0.85);
  EXPECT_LT(map.row(8)[52], 0.95);
  for (const double v : perceived_luminance(layer.reference, 64, 16, 0).values) EXPECT_GT(v, 10);
}

}  // namespace
}  // namespace vsgl::metrics
