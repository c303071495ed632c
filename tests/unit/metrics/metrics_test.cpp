// Each metric against what pen and paper say, and each seen to notice a change that it must notice.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "stages/metrics/layer_metrics.h"

namespace vsgl::metrics {
namespace {

using Image = std::vector<float>;

// 1, 2, ..., n: mean (n+1)/2, mean of squares (n+1)(2n+1)/6.
Image ramp(int n) {
  Image out(static_cast<std::size_t>(n));
  std::iota(out.begin(), out.end(), 1.0f);
  return out;
}
Image mapped(const Image& in, float gain, float offset) {
  Image out = in;
  for (float& v : out) v = gain * v + offset;
  return out;
}

constexpr int kCount = 100;
constexpr double kMean = 50.5, kMeanSquare = 101 * 201 / 6.0;

TEST(Metrics, EqualImagesAreIdeal) {
  const Image a = ramp(kCount);
  for (const ChannelMetric& metric : channel_metrics()) {
    const double value = metric.evaluate(a, a, std::nullopt);
    EXPECT_EQ(value, metric.ideal) << metric.name;
    EXPECT_TRUE(within_limit(metric, value, metric.better == Better::higher ? 1000 : 0)) << metric.name;
  }
}

// a = b + 0.5.
TEST(Metrics, ConstantOffset) {
  const Image b = ramp(kCount), a = mapped(b, 1, 0.5f);
  double relative = 0, regularised = 0, symmetric = 0;
  const double epsilon = 0.505 * 0.505;
  for (int i = 1; i <= kCount; ++i) {
    relative += 0.25 / (i * i) / kCount;
    regularised += 0.25 / (i * i + epsilon) / kCount;
    symmetric += 2 * 0.5 / (2 * i + 0.5) / kCount;
  }
  EXPECT_DOUBLE_EQ(mean_squared_error(a, b), 0.25);
  EXPECT_DOUBLE_EQ(root_mean_squared_error(a, b), 0.5);
  EXPECT_DOUBLE_EQ(mean_absolute_error(a, b), 0.5);
  EXPECT_DOUBLE_EQ(maximum_error(a, b).error, 0.5);
  EXPECT_NEAR(relative_mse_epsilon(b), epsilon, 1e-12);
  EXPECT_NEAR(relative_mse(a, b, relative_mse_epsilon(b)), regularised, 1e-12);
  EXPECT_NEAR(relative_mse(a, b, 0), relative, 1e-12);
  EXPECT_NEAR(mean_relative_squared_error(a, b), relative, 1e-12);
  EXPECT_NEAR(symmetric_mean_absolute_percentage_error(a, b), symmetric, 1e-12);
  EXPECT_NEAR(peak_signal_to_noise_ratio(a, b), 10 * std::log10(100.0 * 100.0 / 0.25), 1e-12);
  EXPECT_NEAR(bias(a, b), (kMean + 0.5) / kMean, 1e-12);
}

TEST(Metrics, Gain) {
  const float gain = 1.0625f;  // exact in binary, and so are all products
  const double g = 0.0625;
  const Image b = ramp(kCount), a = mapped(b, gain, 0);
  EXPECT_DOUBLE_EQ(mean_squared_error(a, b), g * g * kMeanSquare);
  EXPECT_DOUBLE_EQ(root_mean_squared_error(a, b), g * std::sqrt(kMeanSquare));
  EXPECT_DOUBLE_EQ(mean_absolute_error(a, b), g * kMean);
  EXPECT_DOUBLE_EQ(maximum_error(a, b).error, g * kCount);
  EXPECT_EQ(maximum_error(a, b).index, 99u);
  EXPECT_DOUBLE_EQ(mean_relative_squared_error(a, b), g * g);
  EXPECT_NEAR(symmetric_mean_absolute_percentage_error(a, b), 2 * g / (2 + g), 1e-15);
  EXPECT_DOUBLE_EQ(bias(a, b), 1 + g);
  EXPECT_LT(relative_mse(a, b, relative_mse_epsilon(b)), g * g);
  EXPECT_GT(relative_mse(a, b, relative_mse_epsilon(b)), 0.9 * g * g);
  EXPECT_DOUBLE_EQ(peak_signal_to_noise_ratio(a, b), 10 * std::log10(1e4 / (g * g * kMeanSquare)));
}

TEST(Metrics, GainOfFivePercentShowsInEveryMetric) {
  const Image b = ramp(kCount), a = mapped(b, 1.05f, 0);
  EXPECT_NEAR(mean_relative_squared_error(a, b), 0.0025, 1e-7);
  EXPECT_NEAR(bias(a, b), 1.05, 1e-7);
  for (const ChannelMetric& metric : channel_metrics()) {
    const double value = metric.evaluate(a, b, std::nullopt);
    const double strict = metric.better == Better::higher ? 100 : 1e-4;
    EXPECT_FALSE(within_limit(metric, value, strict)) << metric.name;
  }
}

// Signs must not cancel: half the pixels too bright, half too dark.
TEST(Metrics, ErrorsOfBothSignsAddUp) {
  const Image b(10, 2.0f);
  Image a = b;
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += i % 2 == 0 ? 0.5f : -0.5f;
  EXPECT_DOUBLE_EQ(mean_absolute_error(a, b), 0.5);
  EXPECT_DOUBLE_EQ(mean_squared_error(a, b), 0.25);
  EXPECT_DOUBLE_EQ(mean_relative_squared_error(a, b), 0.0625);
  EXPECT_DOUBLE_EQ(symmetric_mean_absolute_percentage_error(a, b), (1 / 4.5 + 1 / 3.5) / 2);
  EXPECT_DOUBLE_EQ(bias(a, b), 1);  // the one metric that is blind to it
}

// A ramp moved by one pixel, its last pixel repeated: 99 errors of 1.
TEST(Metrics, ShiftByOnePixel) {
  const Image b = ramp(kCount);
  Image a(b.begin() + 1, b.end());
  a.push_back(b.back());
  EXPECT_DOUBLE_EQ(mean_squared_error(a, b), 0.99);
  EXPECT_DOUBLE_EQ(mean_absolute_error(a, b), 0.99);
  EXPECT_DOUBLE_EQ(maximum_error(a, b).error, 1);
  EXPECT_EQ(maximum_error(a, b).index, 0u);
  EXPECT_NEAR(bias(a, b), (kMean + 0.99) / kMean, 1e-12);
}

// The reference matters: which side is the test and which the reference is not symmetric.
TEST(Metrics, RelativeToTheReference) {
  const Image one(4, 1.0f), two(4, 2.0f);
  EXPECT_DOUBLE_EQ(mean_relative_squared_error(one, two), 0.25);
  EXPECT_DOUBLE_EQ(mean_relative_squared_error(two, one), 1);
  EXPECT_DOUBLE_EQ(bias(one, two), 0.5);
  EXPECT_DOUBLE_EQ(relative_mse(two, one, 0), 1);
  EXPECT_DOUBLE_EQ(relative_mse(two, one, 1), 0.5);
  EXPECT_DOUBLE_EQ(relative_mse_epsilon(two), 0.0004);
  EXPECT_DOUBLE_EQ(peak_signal_to_noise_ratio(one, two), 10 * std::log10(4.0));
}

TEST(Metrics, BlackReference) {
  const Image black(4, 0.0f), one(4, 1.0f);
  EXPECT_EQ(relative_mse(one, black, 0), HUGE_VAL);
  EXPECT_EQ(relative_mse(black, black, 0), 0);
  EXPECT_EQ(mean_relative_squared_error(one, black), HUGE_VAL);
  EXPECT_EQ(mean_relative_squared_error(black, black), 0);
  EXPECT_EQ(bias(one, black), HUGE_VAL);
  EXPECT_EQ(bias(black, black), 1);
  EXPECT_EQ(peak_signal_to_noise_ratio(one, black), -HUGE_VAL);
  EXPECT_EQ(symmetric_mean_absolute_percentage_error(one, black), 2);
}

TEST(Metrics, BlackPixelsAreLeftOutOfMrse) {
  const Image b = {0, 2, 4}, a = {7, 3, 4};
  EXPECT_DOUBLE_EQ(mean_relative_squared_error(a, b), 0.125);
}

// Four million values about 1 in float: the error of a float sum would be in the third digit.
TEST(Metrics, SumsRunInDouble) {
  const Image b(std::size_t{1} << 22, 0.1f), a = mapped(b, 1, 0.1f);
  const double offset = static_cast<double>(a[0]) - static_cast<double>(b[0]);
  EXPECT_NEAR(mean_squared_error(a, b), offset * offset, 1e-12);
  EXPECT_NEAR(bias(a, b), 1 + offset / static_cast<double>(0.1f), 1e-9);
}

TEST(Metrics, NonFiniteValuesAreCounted) {
  Image a = ramp(kCount);
  EXPECT_EQ(non_finite_count(a), 0u);
  a[3] = std::numeric_limits<float>::quiet_NaN();
  a[50] = std::numeric_limits<float>::infinity();
  a[99] = -std::numeric_limits<float>::infinity();
  EXPECT_EQ(non_finite_count(a), 3u);
}

TEST(Metrics, LimitsPointTheRightWay) {
  const Metric& mse = *find_metric("mse");
  EXPECT_TRUE(within_limit(mse, 0.1, 0.1));
  EXPECT_FALSE(within_limit(mse, 0.2, 0.1));
  EXPECT_FALSE(within_limit(mse, std::nan(""), 0.1));
  const Metric& psnr = *find_metric("psnr_db");
  EXPECT_TRUE(within_limit(psnr, 40, 30));
  EXPECT_FALSE(within_limit(psnr, 20, 30));
  const Metric& ratio = *find_metric("bias");
  EXPECT_TRUE(within_limit(ratio, 0.99, 0.02));
  EXPECT_FALSE(within_limit(ratio, 0.97, 0.02));
  EXPECT_FALSE(within_limit(ratio, 1.03, 0.02));
  EXPECT_EQ(find_metric("likeness"), nullptr);
}

}  // namespace
}  // namespace vsgl::metrics
