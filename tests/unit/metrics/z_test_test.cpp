// The z-test on images of known noise: quiet where only the noise differs, loud for each planted fault.

#include "stages/metrics/z_test.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <random>

#include "../expect_error.h"

namespace vsgl::metrics {
namespace {

using test::expect_error;

constexpr int kWidth = 80, kHeight = 45;
constexpr std::size_t kPixels = kWidth * kHeight;

Colour truth(std::size_t i) {
  const double x = static_cast<double>(i % kWidth) / kWidth, y = static_cast<double>(i / kWidth) / kHeight;
  const double e = std::exp(2 * std::sin(5 * x + 3 * y));
  return {static_cast<float>(e), static_cast<float>(0.6 * e), static_cast<float>(0.3 * e)};
}

struct Measured {
  std::vector<Colour> mean;
  Uncertainty uncertainty;
};
// The truth as `passes` passes measure it whose noise has 30% of the value; passes = 0: variances are known
// exactly.
Measured measure(unsigned seed, int passes) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Measured out;
  const int samples = passes > 0 ? passes : 16;
  for (std::size_t i = 0; i < kPixels; ++i) {
    Colour mean{}, variance{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto value = static_cast<double>(truth(i)[c]);
      double sum = 0, squares = 0;
      for (int s = 0; s < samples; ++s) {
        const double x = value * (1 + 0.3 * normal(random));
        sum += x;
        squares += x * x;
      }
      mean[c] = static_cast<float>(sum / samples);
      const double spread =
          passes > 0 ? (squares - sum * sum / samples) / (samples - 1) : 0.09 * value * value;
      variance[c] = static_cast<float>(spread / samples);
    }
    out.mean.push_back(mean);
    out.uncertainty.variance.push_back(variance);
  }
  if (passes > 0) out.uncertainty.passes = passes;
  return out;
}

struct Case {
  Measured a, b;
  std::vector<char> left_out = std::vector<char>(kPixels, 0);
  explicit Case(int passes = 0, unsigned seed = 1) : a(measure(seed, passes)), b(measure(seed + 1, passes)) {}
  ZTest run() const {
    return z_test({"indirect", kWidth, kHeight, a.mean, b.mean}, left_out, a.uncertainty, b.uncertainty,
                  0.05);
  }
};

bool is_quiet(const ZTest& z) {
  bool quiet = z.exceeding == 0 && z.exact_differing == 0;
  for (const ZTest::Channel& c : z.channels)
    quiet = quiet && c.rms_score <= z.critical && std::abs(c.mean_score) <= z.critical;
  return quiet;
}

// Over 30 pairs of seeds, 0.05 each, more than six false alarms happen once in three thousand.
int false_alarms(int passes) {
  int alarms = 0;
  for (unsigned pair = 0; pair < 30; ++pair)
    if (!is_quiet(Case(passes, 100 + 2 * pair).run())) ++alarms;
  return alarms;
}

TEST(ZTest, QuietBetweenSeeds) {
  EXPECT_LE(false_alarms(0), 6);
}
TEST(ZTest, QuietBetweenSeedsOfFewPasses) {
  EXPECT_LE(false_alarms(4), 6);
}
// Without Student's distribution variances of four passes are not quiet: the number of passes matters.
TEST(ZTest, FewPassesNeedStudent) {
  Case c(4);
  c.a.uncertainty.passes = c.b.uncertainty.passes = std::nullopt;
  EXPECT_FALSE(is_quiet(c.run()));
}

TEST(ZTest, ScoresAreNormal) {
  for (const int passes : {0, 4, 16}) {
    const ZTest z = Case(passes).run();
    for (const ZTest::Channel& c : z.channels) {
      EXPECT_EQ(c.tested, kPixels);
      EXPECT_NEAR(c.rms, 1, 0.05) << passes;
      EXPECT_LT(c.rms_score, 0);
      EXPECT_LT(std::abs(c.mean_score), 4);
    }
    EXPECT_EQ(z.tests, 3 * kPixels + 6);
  }
}

TEST(ZTest, FindsAWrongPixel) {
  Case c;
  const std::size_t i = 1234;
  c.a.mean[i][1] += 8 * std::sqrt(c.a.uncertainty.variance[i][1] + c.b.uncertainty.variance[i][1]);
  const ZTest z = c.run();
  EXPECT_EQ(z.exceeding, 1u);
  EXPECT_EQ(z.worst_pixel, i);
  EXPECT_EQ(z.worst_channel, 1u);
  EXPECT_GT(z.worst_score, 5);
}

TEST(ZTest, FindsNoiseByItsDistribution) {
  Case c;
  std::mt19937 random(9);
  std::normal_distribution<float> normal;
  for (std::size_t i = 0; i < kPixels; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      c.a.mean[i][k] = c.b.mean[i][k] + 3 * std::sqrt(c.b.uncertainty.variance[i][k]) * normal(random);
  c.a.uncertainty = {};
  const ZTest z = c.run();
  for (const ZTest::Channel& channel : z.channels) {
    EXPECT_NEAR(channel.rms, 3, 0.1);
    EXPECT_GT(channel.rms_score, z.critical);
  }
}

// 2% are far inside the noise of a pixel, which is 10%.
TEST(ZTest, FindsAGainByTheMean) {
  Case c;
  for (Colour& colour : c.a.mean)
    for (float& v : colour) v *= 1.02f;
  const ZTest z = c.run();
  EXPECT_EQ(z.exceeding, 0u);
  for (const ZTest::Channel& channel : z.channels) {
    EXPECT_LT(channel.rms_score, z.critical);
    EXPECT_GT(channel.mean_score, z.critical);
    EXPECT_GT(channel.mean_difference, 0);
  }
}

TEST(ZTest, WithoutVarianceEverythingMustBeEqual) {
  Case c;
  for (auto* m : {&c.a, &c.b}) m->uncertainty.variance[7] = {0, 0, 0};
  c.a.mean[7] = c.b.mean[7];
  EXPECT_EQ(c.run().exact, 3u);
  EXPECT_EQ(c.run().exact_differing, 0u);
  c.a.mean[7][2] += 1e-6f;
  const ZTest z = c.run();
  EXPECT_EQ(z.exact, 2u);
  EXPECT_EQ(z.exact_differing, 1u);
  EXPECT_EQ(z.first_exact_pixel, 7u);
  c.left_out[7] = 1;
  EXPECT_EQ(c.run().exact_differing, 0u);
}

// One sample that only one of two images found does not make them differ.
TEST(ZTest, ARareSampleIsNoFault) {
  Case c(16);
  c.b.mean[5] = {0, 0, 0};
  c.b.uncertainty.variance[5] = {0, 0, 0};
  c.a.mean[5] = {100, 100, 100};
  c.a.uncertainty.variance[5] = {1e4f, 1e4f, 1e4f};
  EXPECT_EQ(c.run().exceeding, 0u);
}

// Eight passes may agree by chance, and a pixel may be noisier than all around it: both are no faults.
TEST(ZTest, VariancesAreTakenWithCaution) {
  Case c(8);
  const std::size_t calm = 20 * kWidth + 20, noisy = 20 * kWidth + 60;
  const auto set = [&](std::size_t i, float variance, float difference) {
    c.a.uncertainty.variance[i] = c.b.uncertainty.variance[i] = {variance, variance, variance};
    for (std::size_t k = 0; k < 3; ++k) c.a.mean[i][k] = c.b.mean[i][k] + difference;
  };
  set(calm, 1e-12f, 0.05f * truth(calm)[2]);
  set(noisy, 100, 45);
  EXPECT_EQ(c.run().exceeding, 0u);
  set(calm, 1e-12f, 5 * truth(calm)[0]);
  EXPECT_EQ(c.run().exceeding, 3u);
}

TEST(ZTest, CriticalValueIsSidaks) {
  Case c;
  c.a.mean.resize(1);
  c.b.mean.resize(1);
  c.a.uncertainty.variance.resize(1);
  c.b.uncertainty.variance.resize(1);
  const ZTest z = z_test({"indirect", 1, 1, c.a.mean, c.b.mean}, {0}, c.a.uncertainty, c.b.uncertainty, 0.05);
  EXPECT_EQ(z.tests, 9u);
  // The chance that none of nine normal values exceeds it.
  const double inside = 1 - 2 * boost::math::cdf(boost::math::normal(), -z.critical);
  EXPECT_NEAR(std::pow(inside, 9), 0.95, 1e-12);
}

// Table values of Student's distribution: 2.5% beyond them, as beyond 1.959964 of the normal one.
TEST(NormalScore, FollowsTheTables) {
  EXPECT_NEAR(normal_score(12.7062, 1), 1.959964, 1e-5);
  EXPECT_NEAR(normal_score(2.77645, 4), 1.959964, 1e-5);
  EXPECT_NEAR(normal_score(-2.13145, 15), -1.959964, 1e-5);
  EXPECT_EQ(normal_score(5.5, HUGE_VAL), 5.5);
  EXPECT_EQ(normal_score(0, 3), 0);
  EXPECT_GT(normal_score(1e30, 1000), 30);
  EXPECT_TRUE(std::isfinite(normal_score(1e30, 1000)));
}

ExrPart part_with(std::vector<float> variance) {
  ExrPart part;
  part.levels = {{static_cast<int>(variance.size()), 1, {}}};
  for (const char* name : {"variance.R", "variance.G", "variance.B"})
    part.levels[0].channels[name] = variance;
  return part;
}

TEST(Uncertainty, ComesFromTheFile) {
  ExrPart part = part_with({1, 2});
  EXPECT_EQ(uncertainty_of(part, "r.exr").variance[1], (Colour{2, 2, 2}));
  EXPECT_FALSE(uncertainty_of(part, "r.exr").passes);
  part.attributes["reference.passes"] = 16;
  EXPECT_EQ(uncertainty_of(part, "r.exr").passes, 16);
  EXPECT_TRUE(uncertainty_of(ExrPart{{}, {}, {}, {}, {ExrLevel{1, 1, {}}}}, "r.exr").variance.empty());
}

TEST(Uncertainty, RejectsWhatIsNone) {
  for (const float bad : {-1.0f, NAN, INFINITY})
    expect_error(ErrorCode::invalid_data, {"r.exr: variance"}, [&] {
      uncertainty_of(part_with({1, bad}), "r.exr");
    });
  ExrPart part = part_with({1});
  part.attributes["reference.passes"] = 1;
  expect_error(ErrorCode::invalid_data, {"reference.passes"}, [&] { uncertainty_of(part, "r.exr"); });
}

}  // namespace
}  // namespace vsgl::metrics
