#include "stages/metrics/flicker.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "../expect_error.h"
#include "stages/metrics/spectrum.h"

namespace vsgl::test {
namespace {

using metrics::Colour;
using metrics::FlickerResult;
using metrics::Frame;
using metrics::Frames;

constexpr int kWidth = 96, kHeight = 64, kFrames = 16;

template <class Pixel>
Frame frame_of(Pixel pixel) {
  Frame frame{kWidth, kHeight, {}, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) frame.colours.push_back(pixel(x, y));
  return frame;
}

// A wave that runs a pixel to the right each frame, with a black border on the left. Mean about 2.
Frame scene(int t) {
  return frame_of([&](int x, int y) -> Colour {
    if (x < 8) return {0, 0, 0};
    const auto v = static_cast<float>(2 + std::sin(0.4 * (x - t)) * std::cos(0.3 * y));
    return {v, v / 2, 2 * v};
  });
}

// scene() plus normal noise of the mean 0, the same in all channels.
Frame noisy(int t, double sigma, int seed) {
  std::mt19937 engine(static_cast<std::uint32_t>(seed * 1000 + t));
  std::normal_distribution<double> normal(0, sigma);
  Frame frame = scene(t);
  for (Colour& c : frame.colours) {
    const auto e = static_cast<float>(normal(engine));
    if (c != Colour{})
      for (float& v : c) v += e;
  }
  return frame;
}

FlickerResult measure(const Frames& test, const Frames& reference = scene, int frames = kFrames) {
  return metrics::measure_flicker(frames, test, reference, 60);
}

TEST(Flicker, EqualSequencesHaveNone) {
  const FlickerResult r = measure(scene);
  EXPECT_EQ(r.flicker, 0);
  EXPECT_EQ(r.flicker_raw, 0);
  EXPECT_EQ(r.bias_rms, 0);
  EXPECT_EQ(r.fluctuation, 0);
  EXPECT_EQ(r.step_p999, 0);
  EXPECT_EQ(r.pops, 0u);
  EXPECT_TRUE(r.misaligned.empty());
  EXPECT_TRUE(r.repeated.empty());
  EXPECT_FALSE(r.spectrum);
  EXPECT_EQ(r.pixels, static_cast<std::size_t>((kWidth - 8) * kHeight));
  EXPECT_NEAR(r.mean, 2 * (0.2126 + 0.7152 / 2 + 0.0722 * 2), 0.01);
}

TEST(Flicker, StaticBiasIsNoFlicker) {
  const auto brighter = [](int t) {
    Frame frame = scene(t);
    for (Colour& c : frame.colours)
      if (c != Colour{})
        for (float& v : c) v += 0.5f;
    return frame;
  };
  const FlickerResult r = measure(brighter);
  EXPECT_NEAR(r.flicker, 0, 1e-7);
  EXPECT_NEAR(r.fluctuation, 0, 1e-7);
  EXPECT_NEAR(r.bias_rms, 0.5 / r.mean, 1e-6);
  EXPECT_NEAR(r.bias_mean, 0.5 / r.mean, 1e-6);
  EXPECT_NEAR(r.rmse, 0.5 / r.mean, 1e-6);
}

TEST(Flicker, WhiteNoise) {
  const double sigma = 0.1;
  const FlickerResult r = measure([&](int t) { return noisy(t, sigma, 1); });
  EXPECT_NEAR(r.flicker, sigma * std::sqrt(2.0) / r.mean, 0.01 * r.flicker);
  EXPECT_EQ(r.flicker, r.flicker_raw);
  EXPECT_LT(r.flicker_interval.low, r.flicker);
  EXPECT_GT(r.flicker_interval.high, r.flicker);
  EXPECT_LT(r.flicker_interval.high - r.flicker_interval.low, 0.05 * r.flicker);
  EXPECT_NEAR(r.fluctuation, sigma / r.mean, 0.01 * r.fluctuation);
  EXPECT_LT(r.bias_rms, 0.1 * r.fluctuation);  // without the correction by 1/F it would be a quarter
  EXPECT_NEAR(r.rmse, sigma / r.mean, 0.01 * r.rmse);
  ASSERT_EQ(r.step_rms.size(), static_cast<std::size_t>(kFrames - 1));
  for (const double step : r.step_rms) EXPECT_NEAR(step, r.flicker_raw, 0.05 * r.flicker_raw);
  EXPECT_TRUE(r.misaligned.empty());
}

// What is the reference's own noise is not the test's flicker.
TEST(Flicker, NoiseOfTheReferenceIsSubtracted) {
  const double sigma = 0.1;
  const auto reference = [&](int t) {
    Frame frame = noisy(t, sigma, 2);
    const auto v = static_cast<float>(sigma * sigma);
    frame.variance = frame_of([&](int x, int) { return x < 8 ? Colour{} : Colour{v, v, v}; }).colours;
    return frame;
  };
  const FlickerResult r = measure(scene, reference);
  EXPECT_NEAR(r.flicker_raw, sigma * std::sqrt(2.0) / r.mean, 0.01 * r.flicker_raw);
  EXPECT_LT(r.flicker, 0.1 * r.flicker_raw);
  EXPECT_LT(r.flicker_relative, 0.2 * r.flicker_raw);
  EXPECT_LT(r.fluctuation, 0.2 * sigma / r.mean);
  EXPECT_TRUE(r.misaligned.empty());
}

// Frames that differ by noise only are as near to their neighbours as to their own.
TEST(Flicker, NoiseIsNoShiftInTime) {
  const auto flat = [](int) { return frame_of([](int, int) { return Colour{1, 1, 1}; }); };
  const auto grain = [&](int t) {
    Frame frame = noisy(t, 0.1, 5);
    const Frame moving = scene(t);
    for (std::size_t i = 0; i < frame.colours.size(); ++i)
      for (int c = 0; c < 3; ++c) frame.colours[i][c] += 1 - moving.colours[i][c];
    return frame;
  };
  EXPECT_TRUE(measure(flat, grain, 4).misaligned.empty());
  EXPECT_TRUE(measure(grain, flat, 4).misaligned.empty());
}

TEST(Flicker, BackgroundDoesNotCount) {
  const auto dot = [](double bright) {
    return frame_of([&](int x, int y) {
      const auto v = static_cast<float>(x < 8 && y < 4 ? bright : 0);
      return Colour{v, v, v};
    });
  };
  const FlickerResult r =
      measure([&](int t) { return dot(t % 2 == 0 ? 1 : 1.25); }, [&](int) { return dot(1); });
  EXPECT_EQ(r.pixels, 32u);
  EXPECT_NEAR(r.mean, 1, 1e-6);
  EXPECT_NEAR(r.flicker, 0.25, 1e-6);
  EXPECT_NEAR(r.step_p99, 0.25 / 1.05, 0.001);
}

TEST(Flicker, RelativeFlickerIsThatOfDarkPixelsToo) {
  const auto flat = [](int) {
    return frame_of([](int x, int) { return x < 48 ? Colour{1, 1, 1} : Colour{9, 9, 9}; });
  };
  const auto test = [&](int t) {
    Frame frame = flat(t);
    for (Colour& c : frame.colours)
      for (float& v : c) v *= t % 2 == 0 ? 1.0f : 1.125f;
    return frame;
  };
  const FlickerResult r = measure(test, flat);
  EXPECT_NEAR(r.mean, 5, 1e-6);
  EXPECT_NEAR(r.flicker, 0.125 * std::sqrt((1 + 81) / 2.0) / 5, 1e-6);
  const double dark = 0.125 / (1 + 0.25), bright = 0.125 * 9 / (9 + 0.25);
  EXPECT_NEAR(r.flicker_relative, std::sqrt((dark * dark + bright * bright) / 2), 1e-6);
  EXPECT_NEAR(r.step_p99, bright, 0.003 * bright);
  EXPECT_EQ(r.pops, static_cast<std::size_t>(48 * kHeight * (kFrames - 1)));  // of the bright half
}

TEST(Flicker, DroppedFrameIsDetected) {
  const FlickerResult r = measure([](int t) { return scene(t < 7 ? t : t + 1); });
  EXPECT_GT(r.flicker, 0.01);
  ASSERT_EQ(r.misaligned.size(), 8u);  // the last has no frame behind it to be compared with
  EXPECT_EQ(r.misaligned.front().frame, 7);
  EXPECT_EQ(r.misaligned.front().offset, 1);
  EXPECT_GT(r.step_rms[6], 100 * r.step_rms[5]);
}

TEST(Flicker, RepeatedFrameIsDetected) {
  const FlickerResult r = measure([](int t) { return scene(t == 7 ? 6 : t); });
  EXPECT_GT(r.flicker, 0.01);
  EXPECT_EQ(r.repeated, std::vector<int>{7});
  ASSERT_EQ(r.misaligned.size(), 1u);
  EXPECT_EQ(r.misaligned[0].frame, 7);
  EXPECT_EQ(r.misaligned[0].offset, -1);
  // Where nothing moves there is nothing to repeat.
  const auto still = [](int) { return scene(0); };
  EXPECT_TRUE(measure(still, still).repeated.empty());
}

TEST(Flicker, BootstrapTellsSequencesApart) {
  const FlickerResult weak = measure([](int t) { return noisy(t, 0.1, 1); });
  const FlickerResult strong = measure([](int t) { return noisy(t, 0.11, 2); });
  const FlickerResult other = measure([](int t) { return noisy(t, 0.1, 3); });
  const metrics::Interval more = metrics::flicker_difference(strong, weak);
  EXPECT_GT(more.low, 0);
  EXPECT_LT(more.low, strong.flicker - weak.flicker);
  EXPECT_GT(more.high, strong.flicker - weak.flicker);
  const metrics::Interval same = metrics::flicker_difference(other, weak);
  EXPECT_LT(same.low, 0);
  EXPECT_GT(same.high, 0);
  const metrics::Interval again = metrics::flicker_difference(strong, weak);
  EXPECT_EQ(more.low, again.low);
}

TEST(Flicker, SpectrumFindsTheBand) {
  constexpr int kLong = 128;
  const auto flat = [](int) { return frame_of([](int, int) { return Colour{1, 1, 1}; }); };
  const auto wave = [&](double frequency_hz) {
    return measure(
               [=](int t) {
                 const auto v = static_cast<float>(
                     1 + 0.1 * std::sin(2 * std::numbers::pi * frequency_hz * t / 60) + 0.01 * t);
                 return frame_of([v](int, int) { return Colour{v, v, v}; });
               },
               flat, kLong)
        .spectrum.value();
  };
  const double rms = 0.1 / std::sqrt(2.0);
  const auto visible = wave(10), fast = wave(24), slow = wave(1.5);
  EXPECT_NEAR(visible.all, rms, 0.02 * rms);  // the trend is not in it
  EXPECT_NEAR(visible.visible, rms, 0.02 * rms);
  EXPECT_LT(visible.fast, 0.05 * rms);
  EXPECT_NEAR(fast.fast, rms, 0.02 * rms);
  EXPECT_LT(fast.visible, 0.05 * rms);
  EXPECT_LT(slow.visible, 0.05 * rms);
  EXPECT_LT(slow.fast, 0.05 * rms);
}

TEST(Flicker, SpectrumKeepsThePowerOfNoise) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal(0, 3);
  const metrics::PowerSpectrum spectrum(64);
  double all = 0, half = 0;
  constexpr int kSignals = 400;
  for (int i = 0; i < kSignals; ++i) {
    std::vector<double> signal(64);
    for (double& v : signal) v = normal(engine);
    const auto bins = spectrum.of(signal);
    ASSERT_EQ(bins.size(), 32u);
    for (std::size_t k = 1; k <= 32; ++k) {
      all += bins[k - 1] / kSignals;
      if (k > 16) half += bins[k - 1] / kSignals;
    }
  }
  EXPECT_NEAR(all, 9, 0.05 * 9);
  EXPECT_NEAR(half, 4.5, 0.05 * 4.5);
}

// The highest frequency has no twin of negative frequency.
TEST(Flicker, SpectrumOfTheFastestWave) {
  std::vector<double> signal(64);
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] = i % 2 == 0 ? 1 : -1;
  double all = 0;
  for (const double bin : metrics::PowerSpectrum(64).of(signal)) all += bin;
  EXPECT_NEAR(all, 1, 0.01);
}

TEST(Flicker, BadSequences) {
  const auto black = [](int) { return frame_of([](int, int) { return Colour{}; }); };
  expect_error(ErrorCode::invalid_data, {"black"}, [&] { measure(scene, black); });
  const auto grows = [](int t) {
    Frame frame = scene(t);
    if (t == 3) frame.colours.resize(kWidth * static_cast<std::size_t>(--frame.height));
    return frame;
  };
  expect_error(ErrorCode::wrong_size, {"96x63"}, [&] { measure(grows); });
  expect_error(ErrorCode::wrong_size, {"96x63"}, [&] { measure(scene, grows); });
  expect_error(ErrorCode::internal, {"two frames"}, [&] { measure(scene, scene, 1); });
}

}  // namespace
}  // namespace vsgl::test
