#include "stages/metrics/decomposition.h"

#include <cmath>
#include <optional>
#include <random>

#include "../expect_error.h"

namespace vsgl::test {
namespace {

using metrics::CauseRemoved;
using metrics::Colour;
using metrics::Decomposition;
using metrics::Frame;

constexpr int kWidth = 160, kHeight = 96;

template <class Pixel>
Frame image(Pixel pixel) {
  Frame frame{kWidth, kHeight, {}, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto v = static_cast<float>(pixel(x, y));
      frame.colours.push_back({v, v, v});
    }
  return frame;
}

Frame sum(const Frame& a, const Frame& b) {
  Frame out = a;
  for (std::size_t i = 0; i < out.colours.size(); ++i)
    for (int c = 0; c < 3; ++c) out.colours[i][c] += b.colours[i][c];
  return out;
}

Frame noise(double sigma, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0, sigma);
  return image([&](int, int) { return normal(engine); });
}

// Binary fractions, which single precision adds exactly.
Frame truth() {
  return image([](int x, int) { return x % 2 == 0 ? 1.5 : 2.5; });
}
// Two patterns that are orthogonal to each other, of the mean 0.
Frame checks(double size) {
  return image([=](int x, int y) { return (x / 4 + y / 4) % 2 == 0 ? size : -size; });
}
Frame stripes(double size) {
  return image([=](int x, int) { return x / 8 % 2 == 0 ? size : -size; });
}
Frame constant(double size) {
  return image([=](int, int) { return size; });
}

CauseRemoved removed(const std::string& cause, std::vector<Frame> images) {
  std::vector<std::string> files(images.size());
  for (std::size_t i = 0; i < files.size(); ++i) files[i] = cause + std::to_string(i) + ".exr";
  return {cause, std::move(images), files};
}

Decomposition decompose(const Frame& test, const std::vector<CauseRemoved>& chain,
                        const Frame& reference = truth()) {
  return metrics::decompose(test, chain, reference, "rest");
}

double sum_of_shares(const Decomposition& d) {
  double out = d.remainder.share + d.noise_share;
  for (const auto& step : d.steps) out += step.share;
  return out;
}

TEST(Decomposition, KnownShares) {
  const Frame b = sum(truth(), checks(0.25)), a = sum(sum(b, stripes(0.5)), constant(0.125));
  const Decomposition d =
      decompose(a, {removed("stripes", {sum(b, constant(0.125))}), removed("offset", {b})});
  const double whole = 0.0625 + 0.25 + 0.015625;
  EXPECT_DOUBLE_EQ(d.reference_mean, 2);
  EXPECT_DOUBLE_EQ(d.rms, std::sqrt(whole) / 2);
  EXPECT_DOUBLE_EQ(d.mean, 0.0625);
  ASSERT_EQ(d.steps.size(), 2u);
  EXPECT_EQ(d.steps[0].cause, "stripes");
  EXPECT_NEAR(d.steps[0].share, 0.25 / whole, 1e-12);
  EXPECT_NEAR(d.steps[0].rms, 0.25, 1e-12);
  EXPECT_NEAR(d.steps[0].mean, 0, 1e-12);
  EXPECT_NEAR(d.steps[1].share, 0.015625 / whole, 1e-12);
  EXPECT_NEAR(d.steps[1].mean, 0.0625, 1e-12);
  EXPECT_EQ(d.remainder.cause, "rest");
  EXPECT_NEAR(d.remainder.share, 0.0625 / whole, 1e-12);
  EXPECT_NEAR(d.remainder.power, 0.0625 / whole, 1e-12);
  EXPECT_NEAR(sum_of_shares(d), 1, 1e-12);
  for (const auto& step : {d.steps[0], d.steps[1], d.remainder}) {
    EXPECT_LE(step.share_interval.low, step.share + 1e-12);
    EXPECT_GE(step.share_interval.high, step.share - 1e-12);
  }
  EXPECT_EQ(d.remainder.relmse_after, 0);
  EXPECT_NEAR(d.steps[1].relmse_after, (0.0625 / (2.25 + 4e-4) + 0.0625 / (6.25 + 4e-4)) / 2, 1e-9);
  EXPECT_GT(d.relmse, d.steps[0].relmse_after);
  EXPECT_TRUE(d.unexplained());
}

// Relative weights: the whole is relmse, and an error of a dark pixel counts as much as one of a bright
// pixel.
TEST(Decomposition, RelativeWeights) {
  const Frame dark = image([](int x, int) { return x < kWidth / 2 ? 1.0 / 16 : 4.0; });
  const auto gain = [&](float left, float right) {
    Frame out = dark;
    for (std::size_t i = 0; i < out.colours.size(); ++i)
      for (float& v : out.colours[i]) v *= i % kWidth < kWidth / 2 ? left : right;
    return out;
  };
  const Decomposition d =
      metrics::decompose(gain(1.5f, 1.5f), {removed("dark", {gain(1, 1.5f)}), removed("bright", {dark})},
                         dark, "rest", metrics::Weights::relative);
  EXPECT_NEAR(d.rms * d.rms, d.relmse, 1e-6 * d.relmse);
  EXPECT_NEAR(d.steps[0].share, 0.5, 0.05);  // the epsilon takes some of the dark ones
  EXPECT_NEAR(d.steps[1].share, 0.5, 0.05);
  EXPECT_NEAR(sum_of_shares(d), 1, 1e-12);
  const Decomposition absolute =
      decompose(gain(1.5f, 1.5f), {removed("dark", {gain(1, 1.5f)}), removed("bright", {dark})}, dark);
  EXPECT_LT(absolute.steps[0].share, 0.001);
}

// Errors of opposite signs: the shares still add up, one is negative.
TEST(Decomposition, CancellingErrors) {
  const Frame leaks = sum(truth(), constant(-0.5));
  const Decomposition d = decompose(sum(leaks, constant(0.75)), {removed("leaks", {leaks})});
  EXPECT_NEAR(d.steps[0].share, 0.75 / 0.25, 1e-12);
  EXPECT_NEAR(d.remainder.share, -0.5 / 0.25, 1e-12);
  EXPECT_NEAR(sum_of_shares(d), 1, 1e-12);
  EXPECT_GT(d.steps[0].relmse_after, d.relmse);
}

TEST(Decomposition, EqualImages) {
  const Decomposition d = decompose(truth(), {removed("nothing", {truth()})});
  EXPECT_EQ(d.rms, 0);
  EXPECT_EQ(d.steps[0].share, 0);
  EXPECT_EQ(d.remainder.share, 0);
  EXPECT_FALSE(d.unexplained());
}

// The mean over seeds has noise of its own, which is nobody's error.
TEST(Decomposition, NoiseOfMeansIsSubtracted) {
  const double sigma = 0.4;
  const Frame biased = sum(truth(), checks(0.125));
  std::vector<Frame> seeds;
  for (unsigned seed = 1; seed <= 4; ++seed) seeds.push_back(sum(biased, noise(sigma, seed)));
  const Frame test = sum(biased, noise(sigma, 99));
  const Decomposition d = decompose(test, {removed("sampling", seeds), removed("bias", {truth()})});
  const double sampling = sigma * sigma, bias = 0.125 * 0.125, whole = sampling + bias;
  EXPECT_NEAR(d.steps[0].share, sampling / whole, 0.02);
  EXPECT_NEAR(d.steps[0].power, sampling / whole, 0.02);
  EXPECT_NEAR(d.steps[1].share, bias / whole, 0.01);
  EXPECT_NEAR(d.steps[1].power, bias / whole, 0.01);  // with the noise of the mean it would be 0.3
  EXPECT_LT(d.steps[1].power_interval.low, bias / whole);
  EXPECT_GT(d.steps[1].power_interval.high, bias / whole);
  EXPECT_EQ(d.remainder.power, 0);
  EXPECT_NEAR(sum_of_shares(d), 1, 1e-12);
  // The mean must not hold the image before it.
  seeds[2] = test;
  expect_error(ErrorCode::invalid_data, {"sampling2.exr", "other seeds"},
               [&] { decompose(test, {removed("sampling", seeds)}); });
}

TEST(Decomposition, NoiseOfTheReferenceIsARow) {
  const double sigma = 0.25;
  Frame reference = sum(truth(), noise(sigma, 7));
  const auto v = static_cast<float>(sigma * sigma);
  reference.variance.assign(reference.colours.size(), {v, v, v});
  const Frame test = sum(truth(), checks(0.5));
  const Decomposition d = decompose(test, {removed("checks", {truth()})}, reference);
  const double whole = 0.25 + sigma * sigma;
  EXPECT_NEAR(d.noise_share, sigma * sigma / whole, 0.01);
  EXPECT_NEAR(d.noise_rms, sigma / 2, 0.01 * sigma);
  EXPECT_NEAR(d.steps[0].share, 0.25 / whole, 0.01);
  EXPECT_NEAR(d.remainder.power, 0, 0.01);
  EXPECT_FALSE(d.unexplained());
  EXPECT_TRUE(metrics::is_explained(d, {}));
  EXPECT_NEAR(sum_of_shares(d), 1, 1e-12);
}

// A chain that does not end at the reference's integral is found out, though far below the noise of a pixel.
TEST(Decomposition, WhatIsLeftIsFound) {
  const double sigma = 0.25;
  Frame reference = sum(truth(), noise(sigma, 7));
  const auto v = static_cast<float>(sigma * sigma);
  reference.variance.assign(reference.colours.size(), {v, v, v});
  const Frame test = sum(truth(), checks(0.5));
  const Decomposition d = decompose(test, {removed("checks", {sum(truth(), stripes(0.0625))})}, reference);
  EXPECT_TRUE(d.unexplained());
  EXPECT_FALSE(metrics::is_explained(d, {}));
  EXPECT_NEAR(d.remainder.power, 0.0625 * 0.0625 / (0.25 + sigma * sigma), 0.005);
  EXPECT_TRUE(metrics::is_explained(d, 0.05));
  EXPECT_FALSE(metrics::is_explained(d, 0.001));
}

TEST(Decomposition, Json) {
  const Decomposition d = decompose(sum(truth(), checks(0.5)), {removed("checks", {truth()})});
  const auto json = metrics::to_json(d, {"a.exr", "b.exr", "indirect"}, 0.25);
  EXPECT_EQ(json["result"], "explained");
  EXPECT_EQ(json["steps"][0]["cause"], "checks");
  EXPECT_EQ(json["steps"][0]["files"][0], "checks0.exr");
  EXPECT_DOUBLE_EQ(json["steps"][0]["share"].get<double>(), 1);
  EXPECT_EQ(json["remainder"]["cause"], "rest");
  EXPECT_DOUBLE_EQ(json["limit"].get<double>(), 0.25);
}

TEST(Decomposition, BadChains) {
  Frame small = truth();
  small.height -= 1;
  small.colours.resize(small.colours.size() - kWidth);
  expect_error(ErrorCode::wrong_size, {"step0.exr", "160x95", "160x96"},
               [&] { decompose(truth(), {removed("step", {small})}); });
  expect_error(ErrorCode::wrong_size, {"under test", "160x95"}, [&] { decompose(small, {}); });
  expect_error(ErrorCode::invalid_data, {"black"}, [&] { decompose(truth(), {}, constant(0)); });
}

}  // namespace
}  // namespace vsgl::test
