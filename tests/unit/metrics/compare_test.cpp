#include "stages/metrics/compare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../expect_error.h"

namespace vsgl::metrics {
namespace {

using test::expect_error;

// One part of 4x4 with two levels more, RGB flux that differs per channel, and an id.
ExrFile sample() {
  ExrPart part;
  part.name = "key";
  part.mipmap = true;
  for (int side : {4, 2, 1}) {
    ExrLevel level{side, side, {}};
    for (int c = 0; c < 3; ++c) {
      std::vector<float> plane;
      for (int i = 0; i < side * side; ++i) plane.push_back(static_cast<float>(1 + c + i));
      level.channels[std::string("flux.") + "RGB"[c]] = plane;
    }
    level.channels["id.I"] = std::vector<std::uint32_t>(static_cast<std::size_t>(side * side), 9);
    part.levels.push_back(level);
  }
  ExrPart surface = part;
  surface.name = "key.surface";
  surface.mipmap = false;
  surface.levels.resize(1);
  return {{part, surface}, "a.exr"};
}

float& pixel(ExrFile& file, std::size_t part, std::size_t level, const std::string& channel,
             std::size_t index) {
  return std::get<0>(file.parts.at(part).levels.at(level).channels.at(channel)).at(index);
}

struct Case {
  ExrFile a = sample(), b = sample();
  Options options;
  Case() { b.path = "b.exr"; }
  Comparison run() const { return compare(a, b, options); }
  // Expects exactly one failure, of that kind, whose message holds the fragment.
  void expect_failure(const std::string& kind, const std::string& fragment) const {
    const Comparison result = run();
    ASSERT_EQ(result.failures.size(), 1u);
    EXPECT_EQ(result.failures[0].kind, kind);
    EXPECT_NE(result.failures[0].message.find(fragment), std::string::npos) << result.failures[0].message;
    EXPECT_FALSE(result.identical());
  }
};

TEST(Compare, EqualFilesAreIdentical) {
  const Comparison result = Case().run();
  EXPECT_EQ(result.failures.size(), 0u);
  EXPECT_EQ(result.channels.size(), 16u);  // 4 channels of 3 levels and one
  EXPECT_TRUE(result.identical());
}

TEST(Compare, AnySingleChangedValueIsADifference) {
  for (std::size_t level : {0u, 1u, 2u})
    for (const char* channel : {"flux.R", "flux.G", "flux.B"}) {
      Case c;
      float& value = pixel(c.a, 0, level, channel, 0);
      value = std::nextafter(value, HUGE_VALF);
      c.expect_failure("threshold", "part 'key'");
      c.options.threshold->value = 1e-6;
      EXPECT_TRUE(c.run().failures.empty());
      EXPECT_FALSE(c.run().identical());
    }
}

TEST(Compare, SwappedChannelsAreADifference) {
  Case c;
  auto& channels = c.a.parts[1].levels[0].channels;
  std::swap(channels["flux.R"], channels["flux.B"]);
  const Comparison result = c.run();
  ASSERT_EQ(result.failures.size(), 2u);
  EXPECT_EQ(result.failures[0].channel, "flux.B");
  EXPECT_EQ(result.failures[1].channel, "flux.R");
}

TEST(Compare, ThresholdIsATriple) {
  Case c;
  pixel(c.a, 1, 0, "flux.R", 6) += 0.25f;  // 1 of 16 pixels: 6.25%
  c.options.threshold = Threshold{0.1, 0, std::nullopt};
  c.expect_failure("threshold", "6.25% of the pixels exceed 0.1, the worst by 0.25 (at 2,1)");
  c.options.threshold = Threshold{0.1, 6.25, std::nullopt};
  EXPECT_TRUE(c.run().failures.empty());
  c.options.threshold = Threshold{0.25, 0, std::nullopt};  // "exceeds" is strict
  EXPECT_TRUE(c.run().failures.empty());
  c.options.threshold = Threshold{0.1, 100, 0.2};
  c.expect_failure("hard_limit", "the largest error 0.25 (at 2,1) exceeds the hard limit 0.2");
  c.options.threshold = Threshold{0.1, 100, 0.25};
  EXPECT_TRUE(c.run().failures.empty());
}

TEST(Compare, LimitsBoundMetrics) {
  Case c;
  pixel(c.a, 1, 0, "flux.R", 0) += 1;  // mse 1/16
  c.options.threshold.reset();
  c.options.limits = {{find_metric("mse"), 0.05}};
  c.expect_failure("limit", "channel 'flux.R': mse is 0.0625, beyond the limit 0.05");
  c.options.limits = {{find_metric("mse"), 0.07}};
  EXPECT_TRUE(c.run().failures.empty());
  c.options.limits = {{find_metric("bias"), 1e-3}};
  c.expect_failure("limit", "bias is 1.007");
  c.options.metrics = {find_metric("mae")};  // what is reported does not change what is bounded
  c.expect_failure("limit", "bias is 1.007");
  EXPECT_EQ(c.run().channels[0].metrics.size(), 1u);
}

TEST(Compare, UintsAreComparedExactly) {
  Case c;
  std::get<1>(c.a.parts[1].levels[0].channels["id.I"])[7] = 10;
  c.options.threshold = Threshold{100, 0, 100.0};
  c.expect_failure("threshold", "6.25% of the pixels differ, the first (at 3,1)");
  c.options.threshold = Threshold{0, 7, 0.0};
  EXPECT_TRUE(c.run().failures.empty());
}

TEST(Compare, OneNaNIsAFailureOnEitherSide) {
  for (bool in_test : {true, false}) {
    Case c;
    pixel(in_test ? c.a : c.b, 1, 0, "flux.G", 2) = std::nanf("");
    c.options.threshold = Threshold{1e30, 100, std::nullopt};
    c.expect_failure("non_finite", in_test ? "1 values are NaN or infinite in a.exr, 0 in b.exr"
                                           : "0 values are NaN or infinite in a.exr, 1 in b.exr");
  }
}

TEST(Compare, NaNOnBothSidesIsStillAFailure) {
  Case c;
  for (ExrFile* file : {&c.a, &c.b})
    for (float& v : std::get<0>(file->parts[1].levels[0].channels["flux.G"])) v = std::nanf("");
  c.expect_failure("non_finite", "16 values");
}

TEST(Compare, AllowedNonFinitePixelsAreLeftOut) {
  Case c;
  c.options.allow_non_finite = true;
  pixel(c.a, 1, 0, "flux.G", 2) = HUGE_VALF;
  EXPECT_TRUE(c.run().failures.empty());
  EXPECT_FALSE(c.run().identical());
  pixel(c.a, 1, 0, "flux.G", 5) += 3;
  c.expect_failure("threshold", "the worst by 3 (at 1,1)");  // the place counts the pixel that was left out
  const Comparison result = c.run();
  EXPECT_EQ(result.channels[13].channel, "flux.G");
  EXPECT_EQ(result.channels[13].pixels, 15u);
  EXPECT_EQ(result.channels[13].non_finite_test, 1u);
}

TEST(Compare, StructureHasMessagesOfItsOwn) {
  {
    Case c;
    c.a.parts.pop_back();
    c.b.parts.push_back(c.b.parts[1]);
    c.b.parts[2].name = "other";
    c.a.parts.push_back(c.b.parts[2]);
    c.expect_failure("missing_part", "part 'key.surface': the part is missing in a.exr");
  }
  {
    Case c;
    c.b.parts.erase(c.b.parts.begin());
    c.b.parts.push_back(c.b.parts[0]);
    c.b.parts[1].name = "key.extra";
    const Comparison result = c.run();
    ASSERT_EQ(result.failures.size(), 2u);
    EXPECT_NE(result.failures[0].message.find("missing in a.exr"), std::string::npos);
    EXPECT_NE(result.failures[1].message.find("missing in b.exr"), std::string::npos);
  }
  {
    Case c;
    c.a.parts[0].levels.pop_back();
    c.expect_failure("missing_level", "part 'key', level 2: the mip level is missing in a.exr");
  }
  {
    Case c;
    c.b.parts[1].levels[0].channels.erase("flux.G");
    c.expect_failure("missing_channel", "channel 'flux.G': the channel is missing in b.exr");
  }
  {
    Case c;
    c.a.parts[1].levels[0].channels["flux.R"] = std::vector<std::uint32_t>(16);
    c.expect_failure("channel_type", "FLOAT in one file and UINT in the other");
  }
  {
    Case c;
    c.a.parts[1].levels[0] = c.a.parts[0].levels[1];
    c.expect_failure("size", "part 'key.surface': 2x2 pixels instead of 4x4");
  }
  for (const auto& [width, height] : {std::pair{8, 4}, std::pair{4, 2}}) {
    Case c;
    c.a.parts[1].levels[0].width = width;
    c.a.parts[1].levels[0].height = height;
    c.expect_failure("size", std::to_string(width) + "x" + std::to_string(height) + " pixels instead of 4x4");
  }
}

TEST(Compare, SinglePartsGoTogetherWhateverTheirNames) {
  Case c;
  c.a.parts = {c.a.parts[0]};
  c.b.parts = {c.b.parts[0]};
  c.a.parts[0].name = "";
  EXPECT_TRUE(c.run().identical());
}

TEST(Compare, SelectionOfChannels) {
  Case c;
  pixel(c.a, 1, 0, "flux.R", 0) += 1;
  c.options.exclude = {"flux.R"};
  EXPECT_TRUE(c.run().identical());
  c.options.exclude = {"flux"};
  EXPECT_EQ(c.run().channels.size(), 4u);
  c.options.exclude = {};
  c.options.channels = {"flux.G", "id"};
  EXPECT_EQ(c.run().channels.size(), 8u);
  c.options.channels = {"flux"};
  c.expect_failure("threshold", "flux.R");
  c.options.exclude = {"flux"};
  c.expect_failure("nothing_compared", "no channel was compared");
  c.options.exclude = {"flu"};
  expect_error(ErrorCode::bad_value, {"--exclude flu", "flux.B, flux.G, flux.R, id.I"}, [&] { c.run(); });
  c.options.exclude = {};
  c.options.channels = {"flux.X"};
  expect_error(ErrorCode::bad_value, {"--channels flux.X"}, [&] { c.run(); });
}

TEST(Compare, JsonOfTheResult) {
  Case c;
  c.a.path = "/some/folder/a.exr";
  const auto json = [&] { return to_json(c.run(), c.a, c.b, c.options); };
  EXPECT_EQ(json()["result"], "same");
  EXPECT_EQ(json()["test"]["file"], "a.exr");
  EXPECT_EQ(json()["channels"][0]["metrics"]["psnr_db"], nullptr);  // infinite
  EXPECT_EQ(json()["channels"][0]["metrics"]["bias"], 1.0);
  pixel(c.a, 1, 0, "flux.R", 0) += 1;
  EXPECT_EQ(json()["result"], "differs");
  EXPECT_EQ(json()["failures"][0]["kind"], "threshold");
  c.options.threshold->value = 1;
  EXPECT_EQ(json()["result"], "within_thresholds");
  EXPECT_EQ(json()["threshold"]["hard_limit"], nullptr);
}

}  // namespace
}  // namespace vsgl::metrics
