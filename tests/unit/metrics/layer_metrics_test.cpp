// Metrics of layers against pen and paper, and how compare() judges by them.

#include "stages/metrics/layer_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../expect_error.h"
#include "stages/metrics/compare.h"

namespace vsgl::metrics {
namespace {

using test::expect_error;

LayerPair grey_pair(const std::vector<float>& test, const std::vector<float>& reference, int width) {
  LayerPair out{"indirect", width, static_cast<int>(test.size()) / width, {}, {}};
  for (const float v : test) out.test.push_back({v, v, v});
  for (const float v : reference) out.reference.push_back({v, v, v});
  return out;
}
Uncertainty variance_of(std::size_t pixels, float variance) {
  return {std::vector<Colour>(pixels, {variance, variance, variance}), {}};
}
LayerResult measure(const LayerPair& layer, const Uncertainty& test = {}, const Uncertainty& reference = {},
                    const LayerOptions& options = {}) {
  const auto result = measure_layer(layer, test, reference, options);
  EXPECT_TRUE(result);
  return result.value_or(LayerResult{});
}

TEST(Quantile, InterpolatesBetweenPixels) {
  const std::vector<double> values = {1, 2, 4, 8, 16};
  EXPECT_EQ(quantile(values, 0), 1);
  EXPECT_EQ(quantile(values, 0.5), 4);
  EXPECT_EQ(quantile(values, 1), 16);
  EXPECT_NEAR(quantile(values, 0.875), 12, 1e-12);
  EXPECT_EQ(quantile({7}, 0.3), 7);
}

TEST(WeightedQuantile, HalvesTheSum) {
  EXPECT_EQ(weighted_quantile({0, 0, 0, 1, 1, 2, 5}, 0.5), 5);
  EXPECT_EQ(weighted_quantile({0, 0, 0, 1, 1, 2, 4}, 0.5), 2);
  EXPECT_EQ(weighted_quantile({0, 0}, 0.5), 0);
}

TEST(LogHistogram, BinsAreQuarterDecades) {
  const LogHistogram h = log_histogram({-1, 0, 1e-9, 1.001e-8, 1.001, 1.7, 1.8, 9.9e3, 1.001e4, HUGE_VAL});
  EXPECT_EQ(h.zero_or_less, 2u);
  EXPECT_EQ(h.below, 1u);
  EXPECT_EQ(h.counts[0], 1u);
  EXPECT_EQ(h.counts[32], 2u);  // 1..1.778
  EXPECT_EQ(h.counts[33], 1u);
  EXPECT_EQ(h.counts[47], 1u);
  EXPECT_EQ(h.above, 2u);
}

// 2000 pixels of 1, a tenth off by 10% and one by 100: two pixels are dropped, that one and one of the
// others.
TEST(LayerMetrics, TrimmingDropsTheWorstThousandth) {
  std::vector<float> a(2000, 1), b(2000, 1);
  for (std::size_t i = 0; i < 200; ++i) a[i] = 1.1f;
  a[1000] = 101;
  const LayerResult r = measure(grey_pair(a, b, 50));
  const double each = 0.01 / (1 + 4e-4);  // e = (2% of 1)^2
  EXPECT_NEAR(r.relmse, (200 * each + 10000 / (1 + 4e-4)) / 2000, 1e-4);
  EXPECT_NEAR(r.relmse_trimmed, 199 * each / 1998, 1e-7);
}

TEST(LayerMetrics, PercentilesOfErrors) {
  std::vector<float> a(1001), b(1001, 2);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = 2 + static_cast<float>(i) / 1000;
  const LayerResult r = measure(grey_pair(a, b, 77));
  for (std::size_t k = 0; k < kPercentiles.size(); ++k) {
    EXPECT_NEAR(r.absolute.percentiles[k], kPercentiles[k] / 100, 1e-6);
    EXPECT_NEAR(r.relative.percentiles[k], kPercentiles[k] / 100 / 2.02, 1e-6);  // 2 + 1% of 2
  }
}

// A perfect image against a truth with noise of 10%, v = 0.01: what is left is the noise, unless it is
// subtracted. Then 6 v^2 is left, as b = 1 + n stands in the denominator too: E[(n^2 - v) (1 - 2n + 3n^2)].
TEST(LayerMetrics, DenoisedErrorHasNoFloor) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal(1, 0.1f);
  std::vector<float> a(20000, 1), b;
  for (std::size_t i = 0; i < a.size(); ++i) b.push_back(normal(random));
  const LayerResult r = measure(grey_pair(a, b, 200), {}, variance_of(a.size(), 0.01f));
  EXPECT_NEAR(r.relmse, 0.0103, 0.001);
  ASSERT_TRUE(r.relmse_denoised);
  EXPECT_NEAR(*r.relmse_denoised, 6e-4, 4e-4);
  // Without the worst thousandth, n about -0.32 and n^2 / b^2 about 0.22, some 0.001 (0.22 - 0.02) less.
  ASSERT_TRUE(r.relmse_trimmed_denoised);
  EXPECT_NEAR(*r.relmse_trimmed_denoised, *r.relmse_denoised - 2e-4, 1.5e-4);
  EXPECT_LT(*r.relmse_trimmed_denoised, *r.relmse_denoised);
  EXPECT_FALSE(
      measure(grey_pair(a, b, 200), variance_of(a.size(), 0.01f)).relmse_denoised);  // the test's own
}

TEST(LayerMetrics, BiasHasItsError) {
  const LayerPair layer = grey_pair(std::vector<float>(400, 1.02f), std::vector<float>(400, 1), 20);
  EXPECT_FALSE(measure(layer).luminance_bias_error);
  const LayerResult r = measure(layer, variance_of(400, 0.04f), variance_of(400, 0.09f));
  EXPECT_NEAR(r.luminance_bias, 1.02, 1e-6);
  ASSERT_TRUE(r.luminance_bias_error);
  EXPECT_NEAR(*r.luminance_bias_error, std::sqrt((0.04 + 1.02 * 1.02 * 0.09) / 400), 1e-6);
}

TEST(LayerMetrics, VarianceBelongsToIndirect) {
  LayerPair layer = grey_pair({1, 2}, {2, 1}, 2);
  EXPECT_TRUE(measure(layer, {}, variance_of(2, 1)).z);
  layer.name = "direct";
  const LayerResult r = measure(layer, {}, variance_of(2, 1));
  EXPECT_FALSE(r.z);
  EXPECT_FALSE(r.relmse_denoised);
}

TEST(LayerMetrics, PixelsThatAreNotFiniteDoNotCount) {
  const LayerResult r = measure(grey_pair({1, NAN, 1.5f, 1}, {1, 1, 1, INFINITY}, 2));
  EXPECT_EQ(r.pixels, 2u);
  EXPECT_EQ(r.non_finite, 2u);
  EXPECT_NEAR(r.luminance_bias, 1.25, 1e-6);
  for (const LayerMetric& metric : layer_metrics())
    EXPECT_TRUE(std::isfinite(metric.value(r).value_or(0))) << metric.name;
  EXPECT_FALSE(measure_layer(grey_pair({NAN}, {1}, 1), {}, {}, {}));
}

TEST(LayerMetrics, EqualImagesAreIdeal) {
  const std::vector<float> values = {1, 2, 3, 0, 0, 0, 0, 0};
  const LayerPair layer = grey_pair(values, values, 8);
  LayerOptions options;
  options.seam_tile = 4;
  const LayerResult r = measure(layer, {}, variance_of(values.size(), 1e-20f), options);
  for (const LayerMetric& metric : layer_metrics())
    EXPECT_NEAR(metric.value(r).value_or(NAN), metric.ideal, 1e-12) << metric.name;
}

// Two colours swapped: the luminance of grey pixels would not show it.
TEST(LayerMetrics, ColoursCount) {
  LayerPair layer = grey_pair({1}, {1}, 1);
  layer.test[0] = {3, 1, 0};
  layer.reference[0] = {0, 1, 3};
  const LayerResult r = measure(layer);
  EXPECT_NEAR(r.relmse, 18 / (10 + 3 * std::pow(0.02 * 4 / 3, 2)), 1e-9);
  EXPECT_GT(r.flip->mean, 0.5);
}

ExrFile file_of(const std::vector<float>& values, float variance) {
  ExrPart part;
  ExrLevel level{static_cast<int>(values.size()), 1, {}};
  for (const char* c : {"R", "G", "B"}) {
    level.channels[std::string("indirect.") + c] = values;
    level.channels[std::string("variance.") + c] = std::vector<float>(values.size(), variance);
  }
  part.levels = {level};
  return {{part}, "x.exr"};
}
std::vector<std::string> failures_of(const ExrFile& a, const ExrFile& b, const Options& options) {
  std::vector<std::string> kinds;
  for (const Failure& failure : compare(a, b, options).failures) kinds.push_back(failure.kind);
  return kinds;
}
using Kinds = std::vector<std::string>;

TEST(CompareLayers, LimitsBoundThem) {
  const ExrFile a = file_of({1.1f, 2.2f}, 1), b = file_of({1, 2}, 1);
  Options options;
  options.threshold.reset();
  for (const auto& [name, good, bad] :
       {std::tuple("flip", 0.9, 1e-4), std::tuple("ssim", 0.5, 0.99999),
        std::tuple("relmse_trimmed", 0.1, 0.001), std::tuple("luminance_bias", 0.2, 0.05),
        std::tuple("z_rms", 1.0, 0.01)}) {
    options.limits = {{find_metric(name), good}};
    EXPECT_EQ(failures_of(a, b, options), Kinds{}) << name;
    options.limits = {{find_metric(name), bad}};
    EXPECT_EQ(failures_of(a, b, options), Kinds{"limit"}) << name;
  }
}

TEST(CompareLayers, WhatIsAskedForMustBeThere) {
  Options options;
  options.limits = {{find_metric("flip"), 1}};
  options.channels = {"indirect.R"};
  const ExrFile a = file_of({1, 2}, 1);
  EXPECT_EQ(failures_of(a, a, options), Kinds{"nothing_compared"});
  options.limits = {};
  options.z_test = true;
  EXPECT_EQ(failures_of(a, a, options), Kinds{"nothing_compared"});
}

TEST(CompareLayers, ZTestNeedsTheReferencesVariance) {
  ExrFile b = file_of({1, 2}, 1);
  b.parts[0].levels[0].channels.erase("variance.R");
  Options options;
  options.z_test = true;
  expect_error(ErrorCode::missing_channel, {"x.exr", "variance.R", "--z-test"}, [&] {
    compare(file_of({1, 2}, 1), b, options);
  });
}

TEST(CompareLayers, ZTestSaysWhere) {
  Options options;
  options.threshold.reset();
  options.z_test = true;
  const ExrFile b = file_of({1, 1, 1}, 1e-4f);
  EXPECT_EQ(failures_of(file_of({1.01f, 1, 0.99f}, 0), b, options), Kinds{});
  const Comparison wrong = compare(file_of({1, 1, 2}, 0), b, options);
  ASSERT_FALSE(wrong.failures.empty());
  EXPECT_EQ(wrong.failures[0].kind, "z_pixel");
  EXPECT_NE(wrong.failures[0].message.find("at 2,0"), std::string::npos) << wrong.failures[0].message;
  EXPECT_EQ(failures_of(file_of({1, 1, 1.0001f}, 0), file_of({1, 1, 1}, 0), options), Kinds{"z_exact"});
}

}  // namespace
}  // namespace vsgl::metrics
