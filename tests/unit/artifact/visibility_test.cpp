// Visibility bits on disk, and either kind of visibility by its schema.

#include <gtest/gtest.h>

#include "../expect_error.h"
#include "artifact_samples.h"

namespace vsgl::test {
namespace {

VisibilityBits sample_bits(int lights) {
  VisibilityBits bits;
  bits.width = 5;
  bits.height = 3;
  bits.lights = lights;
  bits.anchor = {1, 2, 3};
  const std::uint32_t last = lights % 32 == 0 ? ~0U : (1U << lights % 32) - 1;
  for (int word = 0; word < bits.words_per_pixel(); ++word)
    for (std::uint32_t pixel = 0; pixel < 15; ++pixel)
      bits.words.push_back((pixel + 1) * 2654435761U * static_cast<std::uint32_t>(word + 1) &
                           (word + 1 == bits.words_per_pixel() ? last : ~0U));
  return bits;
}

TEST(VisibilityBits, RoundTrip) {
  const TemporaryFolder folder;
  for (const int lights : {0, 1, 31, 32, 33, 700}) {
    const VisibilityBits a = sample_bits(lights);
    write(folder / "v.exr", a, sample_provenance());
    const VisibilityBits b = read_visibility_bits(folder / "v.exr");
    EXPECT_EQ(b.width, 5);
    EXPECT_EQ(b.height, 3);
    EXPECT_EQ(b.lights, lights);
    EXPECT_EQ(b.anchor, a.anchor);
    EXPECT_EQ(b.words, a.words);
  }
}

TEST(VisibilityBits, ChannelsAreSortedByWord) {
  const TemporaryFolder folder;
  write(folder / "v.exr", sample_bits(700), sample_provenance());
  const ExrFile file = read_exr(folder / "v.exr");
  std::size_t word = 0;
  for (const auto& [name, plane] : file.parts[0].levels[0].channels) {
    const auto& words = std::get<std::vector<std::uint32_t>>(plane);
    const VisibilityBits bits = sample_bits(700);
    EXPECT_TRUE(std::equal(words.begin(), words.end(), bits.words.begin() + static_cast<int>(15 * word)));
    ++word;
  }
  EXPECT_EQ(word, 22u);
}

TEST(VisibilityBits, SchemaTellsTheKind) {
  const TemporaryFolder folder;
  write(folder / "bits.exr", Visibility(sample_bits(40)), sample_provenance());
  write(folder / "maps.exr", Visibility(sample_shadow_maps(5)), sample_provenance());
  EXPECT_EQ(std::get<VisibilityBits>(read_visibility(folder / "bits.exr")).words, sample_bits(40).words);
  EXPECT_EQ(std::get<ShadowMaps>(read_visibility(folder / "maps.exr")).views.size(), 5u);
  write(folder / "lights.exr", sample_lights(3, false), sample_provenance());
  expect_error(ErrorCode::wrong_schema, {"lights.exr", "'ism' or 'visibility' or 'cut' or 'unshadowed' is needed"},
               [&] { read_visibility(folder / "lights.exr"); });
}

TEST(VisibilityBits, ReaderErrors) {
  const TemporaryFolder folder;
  write(folder / "valid.exr", sample_bits(40), sample_provenance());
  const auto expect = [&](ErrorCode code, std::vector<std::string> fragments, auto change) {
    rewrite(folder / "valid.exr", folder / "broken.exr", [&](ExrFile& file) { change(file.parts[0]); });
    fragments.push_back("broken.exr");
    expect_error(code, fragments, [&] { read_visibility(folder / "broken.exr"); });
  };
  const auto word = [](ExrPart & part, int index) -> auto& {
    return std::get<std::vector<std::uint32_t>>(
        part.levels[0].channels.at("visibility.0000" + std::to_string(index)));
  };
  EXPECT_NO_THROW(read_visibility(folder / "valid.exr"));
  expect(ErrorCode::missing_channel, {"'visibility.00001' is missing"},
         [](ExrPart& part) { part.levels[0].channels.erase("visibility.00001"); });
  expect(ErrorCode::wrong_channel_type, {"visibility.00000", "is FLOAT but must be UINT"},
         [](ExrPart& part) { part.levels[0].channels["visibility.00000"] = std::vector<float>(15); });
  expect(ErrorCode::invalid_data, {"visibility.00001", "beyond the 40", "(2,1)"},
         [&](ExrPart& part) { word(part, 1)[7] |= 1U << 8; });
  expect(ErrorCode::wrong_size, {"2 channels for 20 lights"}, [&](ExrPart& part) {
    part.attributes["visibility.lights"] = 20;
    for (auto& w : word(part, 0)) w &= (1U << 20) - 1;
  });
  expect(ErrorCode::invalid_data, {"'visibility.lights' is -1"},
         [](ExrPart& part) { part.attributes["visibility.lights"] = -1; });
  expect(ErrorCode::missing_attribute, {"anchor"}, [](ExrPart& part) { part.attributes.erase("anchor"); });
}

TEST(Unshadowed, RoundTripAndReaderErrors) {
  const TemporaryFolder folder;
  write(folder / "valid.exr", Visibility(Unshadowed{700, {1, 2, 3}}), sample_provenance());
  const auto read = std::get<Unshadowed>(read_visibility(folder / "valid.exr"));
  EXPECT_EQ(read.lights, 700);
  EXPECT_EQ(read.anchor, (Vec3{1, 2, 3}));
  const auto expect = [&](ErrorCode code, std::vector<std::string> fragments, auto change) {
    rewrite(folder / "valid.exr", folder / "broken.exr", [&](ExrFile& file) { change(file.parts[0]); });
    fragments.push_back("broken.exr");
    expect_error(code, fragments, [&] { read_visibility(folder / "broken.exr"); });
  };
  expect(ErrorCode::invalid_data, {"visibility.V", "one value, 1"},
         [](ExrPart& part) { part.levels[0].channels["visibility.V"] = std::vector{0.5f}; });
  expect(ErrorCode::missing_channel, {"visibility.V"}, [](ExrPart& part) {
    part.levels[0].channels = {{"other.V", std::vector{1.0f}}};
  });
  expect(ErrorCode::invalid_data, {"'visibility.lights' is -1"},
         [](ExrPart& part) { part.attributes["visibility.lights"] = -1; });
  expect(ErrorCode::missing_attribute, {"anchor"}, [](ExrPart& part) { part.attributes.erase("anchor"); });
}

TEST(VisibilityBits, WithoutLightsNoBitIsSet) {
  const TemporaryFolder folder;
  write(folder / "valid.exr", sample_bits(0), sample_provenance());
  rewrite(folder / "valid.exr", folder / "broken.exr", [](ExrFile& file) {
    std::get<std::vector<std::uint32_t>>(file.parts[0].levels[0].channels.at("visibility.00000"))[4] = 1;
  });
  expect_error(ErrorCode::invalid_data, {"visibility.00000", "(4,0)"},
               [&] { read_visibility(folder / "broken.exr"); });
}

}  // namespace
}  // namespace vsgl::test
