// cut.exr: round trips, and a reader that trusts no list.

#include <gtest/gtest.h>

#include "../expect_error.h"
#include "artifact_samples.h"

namespace vsgl::test {
namespace {

using Words = std::vector<std::uint32_t>;

// 3 x 2 tiles, cut off at both edges; the second has no entries.
Cut sample_cut(std::uint32_t entries_a_tile, bool masks, bool shares) {
  Cut cut;
  cut.width = 37;
  cut.height = 20;
  cut.anchor = {1, 2, 3};
  cut.lights = 5000;
  cut.error = 0.02;
  for (std::uint32_t tile = 0; tile < 6; ++tile) {
    const std::uint32_t count = tile == 1 ? 0 : entries_a_tile + tile;
    const auto first = static_cast<std::uint32_t>(cut.nodes.size());
    cut.tiles.push_back({first, count, 0.001f * static_cast<float>(tile)});
    for (std::size_t k = 0; k < Cut::kRing; ++k)
      cut.tiles.back().gain[k] = 1 + 0.01f * static_cast<float>(tile + k);
    for (std::uint32_t i = 0; i < count; ++i) cut.nodes.push_back((7 * i + tile) % 5000);
  }
  if (!masks) return cut;
  for (std::uint32_t i = 0; i < cut.nodes.size(); ++i) cut.masks.push_back(i % 3);
  cut.mask_words.assign(3 * interop::MASK_WORDS, ~0U);
  for (std::uint32_t w = interop::MASK_WORDS; w < cut.mask_words.size(); ++w)
    cut.mask_words[w] = w * 2654435761U;
  if (!shares) return cut;
  for (int i = 0; i < cut.width * cut.height; ++i)
    cut.visibility.push_back(static_cast<float>(i % 101) / 100);
  return cut;
}

void expect_equal(const Cut& a, const Cut& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.anchor, b.anchor);
  EXPECT_EQ(a.lights, b.lights);
  EXPECT_EQ(a.error, b.error);
  ASSERT_EQ(a.tiles.size(), b.tiles.size());
  for (std::size_t i = 0; i < a.tiles.size(); ++i) {
    EXPECT_EQ(a.tiles[i].first, b.tiles[i].first);
    EXPECT_EQ(a.tiles[i].count, b.tiles[i].count);
    EXPECT_EQ(a.tiles[i].error, b.tiles[i].error);
    EXPECT_EQ(a.tiles[i].gain, b.tiles[i].gain);
  }
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.masks, b.masks);
  EXPECT_EQ(a.mask_words, b.mask_words);
  EXPECT_EQ(a.visibility, b.visibility);
  EXPECT_EQ(a.has_visibility(), b.has_visibility());
}

TEST(CutFile, RoundTrip) {
  const TemporaryFolder folder;
  for (const std::uint32_t entries : {0U, 1U, 200U, 1024U, 3000U})
    for (const auto& [masks, shares] :
         {std::pair(false, false), std::pair(true, false), std::pair(true, true)}) {
      const Cut cut = sample_cut(entries, masks, shares);
      write(folder / "cut.exr", cut, sample_provenance());
      expect_equal(read_cut(folder / "cut.exr"), cut);
      expect_equal(std::get<Cut>(read_visibility(folder / "cut.exr")), cut);
    }
}

TEST(CutFile, WithoutAnyEntry) {
  const TemporaryFolder folder;
  Cut cut = sample_cut(0, false, false);
  for (Cut::Tile& tile : cut.tiles) tile = {};
  cut.nodes.clear();
  write(folder / "cut.exr", cut, sample_provenance());
  expect_equal(read_cut(folder / "cut.exr"), cut);
}

class CutErrors : public testing::Test {
 protected:
  CutErrors() { write(folder_ / "valid.exr", sample_cut(200, true, true), sample_provenance()); }
  void expect(ErrorCode code, std::vector<std::string> fragments,
              const std::function<void(ExrFile&)>& change) {
    rewrite(folder_ / "valid.exr", folder_ / "broken.exr", change);
    fragments.push_back("broken.exr");
    expect_error(code, fragments, [&] { read_cut(folder_ / "broken.exr"); });
  }
  static ExrPart& part(ExrFile& file, const std::string& name) {
    return *std::ranges::find(file.parts, name, &ExrPart::name);
  }
  static Words& words(ExrFile& file, const std::string& name, const std::string& channel) {
    return std::get<Words>(part(file, name).levels[0].channels.at(channel));
  }

  TemporaryFolder folder_;
};

TEST_F(CutErrors, TheValidFileIsRead) {
  EXPECT_NO_THROW(read_cut(folder_ / "valid.exr"));
}

TEST_F(CutErrors, MissingPartsAndChannels) {
  for (const char* name : {"tiles", "entries", "masks"})
    expect(ErrorCode::missing_part, {name}, [&](ExrFile& file) {
      std::erase_if(file.parts, [&](const ExrPart& p) { return p.name == name; });
    });
  expect(ErrorCode::missing_channel, {"node.I"},
         [](ExrFile& file) { part(file, "entries").levels[0].channels.erase("node.I"); });
  expect(ErrorCode::missing_channel, {"mask.I"},
         [](ExrFile& file) { part(file, "entries").levels[0].channels.erase("mask.I"); });
  expect(ErrorCode::missing_channel, {"mask.7"},
         [](ExrFile& file) { part(file, "masks").levels[0].channels.erase("mask.7"); });
}

TEST_F(CutErrors, ListsThatDoNotAddUp) {
  expect(ErrorCode::invalid_data, {"first.I", "do not follow one another"},
         [](ExrFile& file) { ++words(file, "tiles", "first.I")[2]; });
  expect(ErrorCode::invalid_data, {"do not"}, [](ExrFile& file) { ++words(file, "tiles", "count.I")[0]; });
  expect(ErrorCode::invalid_data, {"count.I", "do not add up"},
         [](ExrFile& file) { ++words(file, "tiles", "count.I")[5]; });
  expect(ErrorCode::wrong_size, {"the header counts"},
         [](ExrFile& file) { part(file, "tiles").attributes["cut.entries"] = 100000; });
}

TEST_F(CutErrors, IndicesOutOfRange) {
  expect(ErrorCode::invalid_data, {"node.I", "no such light"},
         [](ExrFile& file) { words(file, "entries", "node.I")[17] = 5000; });
  expect(ErrorCode::invalid_data, {"mask.I", "no such mask"},
         [](ExrFile& file) { words(file, "entries", "mask.I")[17] = 3; });
}

TEST_F(CutErrors, ValuesOutOfRange) {
  expect(ErrorCode::invalid_data, {"error.V"}, [](ExrFile& file) {
    std::get<std::vector<float>>(part(file, "tiles").levels[0].channels.at("error.V"))[3] = -1;
  });
  expect(ErrorCode::invalid_data, {"cut.error"},
         [](ExrFile& file) { part(file, "tiles").attributes["cut.error"] = 2.0; });
}

}  // namespace
}  // namespace vsgl::test
