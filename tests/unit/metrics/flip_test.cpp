// FLIP against closed forms, against a second implementation with plain two-dimensional filters, and on
// images that break careless code.

#include "stages/metrics/flip.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numeric>

namespace vsgl::metrics {
namespace {

constexpr double kPpd = kFlipPixelsPerDegree;

LayerPair constant_pair(const Colour& test, const Colour& reference, int side = 16) {
  const auto n = static_cast<std::size_t>(side * side);
  return {"indirect", side, side, std::vector<Colour>(n, test), std::vector<Colour>(n, reference)};
}

double mean(const Grid& grid) {
  return std::accumulate(grid.values.begin(), grid.values.end(), 0.0) /
         static_cast<double>(grid.values.size());
}

// Smooth colours over six stops with black squares; the test has a gain that waves, an offset and a blue
// cast.
LayerPair wavy_pair(int width = 64, int height = 48) {
  LayerPair out{"indirect", width, height, {}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = static_cast<double>(x) / width, v = static_cast<double>(y) / height;
      const double e = std::exp2(6 * u - 3);
      Colour b = {static_cast<float>(e * (0.6 + 0.4 * std::sin(9 * u + 5 * v))),
                  static_cast<float>(e * (0.5 + 0.5 * std::cos(7 * v - 3 * u))),
                  static_cast<float>(e * (0.4 + 0.4 * std::sin(20 * u * v)))};
      if ((x / 8 + y / 8) % 5 == 0) b = {0, 0, 0};
      Colour a = b;
      a[0] *= static_cast<float>(1 + 0.3 * std::sin(40 * v));
      a[1] += static_cast<float>(0.05 * ((x * 7 + y * 13) % 11) / 11.0);
      if (x > width / 2) a[2] *= 0.7f;
      out.test.push_back(a);
      out.reference.push_back(b);
    }
  return out;
}

LayerPair swapped(LayerPair layer) {
  std::swap(layer.test, layer.reference);
  return layer;
}

TEST(Flip, EqualImagesHaveNone) {
  LayerPair layer = wavy_pair();
  layer.test = layer.reference;
  for (const FlipMode mode : {FlipMode::hdr, FlipMode::ldr}) {
    for (const double v : flip(layer, mode, kPpd).map.values) EXPECT_EQ(v, 0);
  }
}

// Constant images have no features, so that only the colours count. Pure green and pure blue are by
// definition as far apart as colours of a display can be.
TEST(Flip, GreenAndBlueAreFarthestApart) {
  const FlipResult result = flip(constant_pair({0, 1, 0}, {0, 0, 1}), FlipMode::ldr, kPpd);
  for (const double v : result.map.values) EXPECT_NEAR(v, 1, 1e-12);
}

// CIE lightness of a grey of linear value y.
double lightness(double y) {
  return y > 216.0 / 24389.0 ? 116 * std::cbrt(y) - 16 : y * 24389.0 / 27.0;
}
// Hunt-adjusted HyAB distance of green and blue: L*, a*, b* of the sRGB primaries with white D65, tabulated.
double largest_distance() {
  const double green[3] = {87.7350, -86.1829, 83.1795}, blue[3] = {32.2957, 79.1870, -107.8614};
  return green[0] - blue[0] +
         std::hypot(0.01 * (green[0] * green[1] - blue[0] * blue[1]),
                    0.01 * (green[0] * green[2] - blue[0] * blue[2]));
}

TEST(Flip, GreysHaveAClosedForm) {
  const double largest = std::pow(largest_distance(), 0.7), knee = 0.4 * largest;
  for (const auto& [a, b] : {std::pair(0.0, 1.0), std::pair(0.2, 0.25), std::pair(0.5, 0.001)}) {
    const double error = std::pow(std::abs(lightness(a) - lightness(b)), 0.7);
    const double expected =
        error < knee ? 0.95 * error / knee : 0.95 + 0.05 * (error - knee) / (largest - knee);
    const auto fa = static_cast<float>(a), fb = static_cast<float>(b);
    const FlipResult result = flip(constant_pair({fa, fa, fa}, {fb, fb, fb}), FlipMode::ldr, kPpd);
    for (const double v : result.map.values) EXPECT_NEAR(v, expected, 2e-5) << a << " " << b;
  }
}

TEST(Flip, LdrIsSymmetric) {
  const LayerPair layer = wavy_pair();
  EXPECT_EQ(flip(layer, FlipMode::ldr, kPpd).map.values,
            flip(swapped(layer), FlipMode::ldr, kPpd).map.values);
}

// Means of this image from an independent implementation of the papers' formulas in NumPy, with 21 x 21 and
// 19 x 19 filters that are not separated, at 67.0206 pixels per degree.
TEST(Flip, AgreesWithFiltersThatAreNotSeparated) {
  const FlipResult ldr = flip(wavy_pair(), FlipMode::ldr, 67.0206),
                   hdr = flip(wavy_pair(), FlipMode::hdr, 67.0206);
  EXPECT_NEAR(mean(ldr.map), 0.238667020, 2e-7);
  EXPECT_NEAR(ldr.map.values[10 * 64 + 20], 0.143685482, 2e-7);
  EXPECT_NEAR(mean(hdr.map), 0.342433269, 2e-7);
  EXPECT_NEAR(hdr.map.values[10 * 64 + 20], 0.151100867, 2e-7);
  EXPECT_NEAR(hdr.exposures.start, -1.525378237, 1e-6);
  EXPECT_NEAR(hdr.exposures.stop, 2.242939448, 1e-6);
  EXPECT_EQ(hdr.exposures.count, 4);
}

// A thin line on grey is a point feature: worse than the same mean difference spread out.
TEST(Flip, FeaturesRaiseTheError) {
  LayerPair flat = constant_pair({0.3f, 0.3f, 0.3f}, {0.28f, 0.28f, 0.28f}, 33);
  LayerPair line = constant_pair({0.28f, 0.28f, 0.28f}, {0.28f, 0.28f, 0.28f}, 33);
  for (std::size_t y = 0; y < 33; ++y) line.test[33 * y + 16] = {0.94f, 0.94f, 0.94f};
  const Grid a = flip(flat, FlipMode::ldr, kPpd).map, b = flip(line, FlipMode::ldr, kPpd).map;
  EXPECT_GT(b.values[33 * 16 + 16], 1.5 * a.values[33 * 16 + 16]);
}

TEST(Flip, NearerViewersSeeMore) {
  EXPECT_GT(mean(flip(wavy_pair(), FlipMode::ldr, 30).map), mean(flip(wavy_pair(), FlipMode::ldr, 90).map));
}

// The eye adapts: a scaled pair shows the same.
TEST(Flip, HdrIgnoresTheScale) {
  LayerPair scaled = wavy_pair();
  for (auto* image : {&scaled.test, &scaled.reference})
    for (Colour& c : *image)
      for (float& v : c) v *= 1024;
  const FlipResult a = flip(wavy_pair(), FlipMode::hdr, kPpd), b = flip(scaled, FlipMode::hdr, kPpd);
  EXPECT_NEAR(a.exposures.start - 10, b.exposures.start, 1e-9);
  for (std::size_t i = 0; i < a.map.values.size(); ++i) EXPECT_NEAR(a.map.values[i], b.map.values[i], 1e-9);
}

TEST(Flip, ToneMapperInvertsAtTheTarget) {
  LayerPair layer = constant_pair({1, 1, 1}, {3, 3, 3});
  const ExposureRange range = hdr_exposures(layer.reference);
  EXPECT_NEAR(tone_map(3 * std::exp2(range.start)), 0.85, 1e-12);
  EXPECT_EQ(range.start, range.stop);
  EXPECT_EQ(range.count, 1);
  EXPECT_EQ(tone_map(0), 0);
  EXPECT_NEAR(tone_map(1 - 1e-9), tone_map(1 + 1e-9), 1e-8);  // both forms
  EXPECT_EQ(tone_map(1e300), 1);
  EXPECT_EQ(tone_map(HUGE_VAL), 1);
}

TEST(Flip, BackgroundMayBeBlack) {
  LayerPair layer = constant_pair({0, 0, 0}, {0, 0, 0});
  for (std::size_t i = 0; i < 20; ++i) {
    layer.reference[i] = {1, 1, 1};
    layer.test[i] = {1.5f, 1.5f, 1.5f};
  }
  const FlipResult result = flip(layer, FlipMode::hdr, kPpd);
  EXPECT_TRUE(std::isfinite(result.exposures.stop));
  EXPECT_GT(mean(result.map), 0.01);
  EXPECT_EQ(result.out_of_range, 0u);
}

TEST(Flip, BlackReferenceIsDefined) {
  const FlipResult result = flip(constant_pair({1, 1, 1}, {0, 0, 0}), FlipMode::hdr, kPpd);
  EXPECT_EQ(result.exposures.count, 1);
  EXPECT_EQ(result.exposures.start, 0);
  const double grey = lightness(tone_map(1));
  EXPECT_GT(grey, 80);
  for (const double v : result.map.values) EXPECT_GT(v, 0.9);
}

TEST(Flip, OddValuesAreShownAsTheNearestAndCounted) {
  LayerPair layer = wavy_pair(), clean = wavy_pair();
  layer.test[100] = {-5, 0.1f, 0.2f};
  clean.test[100] = {0, 0.1f, 0.2f};
  layer.reference[200] = {-1, -1, -1};
  clean.reference[200] = {0, 0, 0};
  const FlipResult a = flip(layer, FlipMode::hdr, kPpd), b = flip(clean, FlipMode::hdr, kPpd);
  EXPECT_EQ(a.map.values, b.map.values);
  EXPECT_EQ(a.out_of_range, 2u);
  EXPECT_EQ(b.out_of_range, 0u);
  EXPECT_GT(flip(clean, FlipMode::ldr, kPpd).out_of_range, 100u);  // brighter than the display
}

// The largest floats there are, and images smaller than the filters.
TEST(Flip, ExtremesStayInRange) {
  LayerPair layer = wavy_pair(3, 2);
  layer.test[1] = {3e38f, 3e38f, 0};
  layer.reference[4] = {1e-38f, 3e38f, 0};
  for (const double v : flip(layer, FlipMode::hdr, kPpd).map.values) {
    EXPECT_GE(v, 0);
    EXPECT_LE(v, 1);
  }
}

TEST(Flip, ThreadsDoNotMatter) {
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Grid one = flip(wavy_pair(), FlipMode::hdr, kPpd).map;
  omp_set_num_threads(3);
  const Grid three = flip(wavy_pair(), FlipMode::hdr, kPpd).map;
  omp_set_num_threads(threads);
  EXPECT_EQ(one.values, three.values);
}

}  // namespace
}  // namespace vsgl::metrics
