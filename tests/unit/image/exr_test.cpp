#include "image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "../expect_error.h"

namespace vsgl {
namespace {

using test::expect_error;
using test::TemporaryFolder;

ExrLevel noise_level(int width, int height, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<float> normal(0, 1e3f);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<float> x(pixels), y(pixels);
  std::vector<std::uint32_t> id(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    x[i] = normal(engine);
    y[i] = normal(engine) * 1e-20f;
    id[i] = static_cast<std::uint32_t>(engine());
  }
  x[0] = -0.0f;
  x.back() = std::numeric_limits<float>::denorm_min();
  id[0] = 0xFFFFFFFFu;
  return {width, height, {{"flux.R", x}, {"flux.G", y}, {"id.I", id}}};
}

ExrPart scan_line_part(const std::string& name, int width, int height) {
  ExrPart part;
  part.name = name;
  part.attributes = {{"count", 42},
                     {"radius", 1.0 / 3},
                     {"method", std::string("fis-2016")},
                     {"anchor", std::array<double, 3>{1, 1e9 + 1e-6, -3}},
                     {"view", std::array<double, 16>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}}};
  part.levels = {noise_level(width, height, 7)};
  return part;
}
ExrPart mip_part(const std::string& name, int width, int height) {
  ExrPart part;
  part.name = name;
  part.mipmap = true;
  for (int l = 0; (std::max(width, height) >> l) > 0; ++l)
    part.levels.push_back(
        noise_level(std::max(1, width >> l), std::max(1, height >> l), static_cast<unsigned>(l)));
  return part;
}

void expect_same(const ExrFile& a, const ExrFile& b) {
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    EXPECT_EQ(a.parts[i].name, b.parts[i].name);
    EXPECT_EQ(a.parts[i].mipmap, b.parts[i].mipmap);
    EXPECT_EQ(a.parts[i].compression, b.parts[i].compression);
    for (const auto& [name, value] : a.parts[i].attributes)
      EXPECT_EQ(b.parts[i].attributes.at(name), value) << name;
    ASSERT_EQ(a.parts[i].levels.size(), b.parts[i].levels.size());
    for (std::size_t l = 0; l < a.parts[i].levels.size(); ++l) {
      EXPECT_EQ(a.parts[i].levels[l].width, b.parts[i].levels[l].width);
      EXPECT_EQ(a.parts[i].levels[l].height, b.parts[i].levels[l].height);
      EXPECT_EQ(a.parts[i].levels[l].channels, b.parts[i].levels[l].channels) << "level " << l;
    }
  }
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(Exr, RoundTripIsExactForEveryCompression) {
  const TemporaryFolder folder;
  for (ExrCompression compression :
       {ExrCompression::none, ExrCompression::zips, ExrCompression::zip, ExrCompression::piz}) {
    ExrFile file{{scan_line_part("a", 37, 21)}, ""};
    file.parts[0].compression = compression;
    write_exr(folder / "a.exr", file);
    expect_same(file, read_exr(folder / "a.exr"));
  }
}

TEST(Exr, PartsMayMixSizesAndMipMaps) {
  const TemporaryFolder folder;
  ExrFile file{{mip_part("key", 128, 128), scan_line_part("key.surface", 128, 128), mip_part("odd", 77, 10),
                scan_line_part("row", 1, 300)},
               ""};
  write_exr(folder / "a.exr", file);
  const ExrFile back = read_exr(folder / "a.exr");
  expect_same(file, back);
  EXPECT_EQ(back.part("odd").levels.back().width, 1);
  EXPECT_EQ(back.part("key").levels.size(), 8u);
}

TEST(Exr, BytesDoNotDependOnThreads) {
  const TemporaryFolder folder;
  ExrFile file{{mip_part("key", 256, 256), scan_line_part("s", 256, 100)}, ""};
  for (ExrPart& part : file.parts) part.compression = ExrCompression::zip;
  std::vector<std::string> results;
  for (int threads : {0, 1, 2, 5}) {
    set_exr_threads(threads);
    write_exr(folder / "a.exr", file);
    results.push_back(bytes_of(folder / "a.exr"));
    expect_same(file, read_exr(folder / "a.exr"));
  }
  set_exr_threads(0);
  for (const std::string& result : results) EXPECT_TRUE(result == results.front());
}

TEST(Exr, HalfIsWidened) {
  const TemporaryFolder folder;
  const std::string path = (folder / "half.exr").string();
  std::vector<half> pixels = {half(0.5f), half(-3.25f), half(65504.0f), half(6e-8f)};
  {
    Imf::Header header(2, 2);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    Imf::FrameBuffer buffer;
    buffer.insert(
        "Y", Imf::Slice(Imf::HALF, reinterpret_cast<char*>(pixels.data()), sizeof(half), 2 * sizeof(half)));
    Imf::OutputFile out(path.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(2);
  }
  const ExrFile file = read_exr(path);
  const auto& values = float_channel(file, file.parts[0], 0, "Y");
  for (std::size_t i = 0; i < pixels.size(); ++i) EXPECT_EQ(values[i], static_cast<float>(pixels[i]));
}

TEST(Exr, DataWindowNeedNotStartAtZero) {
  const TemporaryFolder folder;
  const std::string path = (folder / "window.exr").string();
  std::vector<float> pixels = {1, 2, 3, 4, 5, 6};
  {
    Imf::Header header(Imath::Box2i({0, 0}, {99, 99}), Imath::Box2i({10, -20}, {12, -19}));
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, pixels.data(), header.dataWindow()));
    Imf::OutputFile out(path.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(2);
  }
  const ExrFile file = read_exr(path);
  EXPECT_EQ(file.parts[0].width(), 3);
  EXPECT_EQ(float_channel(file, file.parts[0], 0, "Y"), pixels);
}

TEST(Exr, NonFinitePixelIsNeverWritten) {
  const TemporaryFolder folder;
  for (float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
    ExrFile file{{mip_part("key", 16, 16)}, "a.exr"};
    std::get<0>(file.parts[0].levels[1].channels["flux.R"])[8 * 3 + 5] = bad;
    expect_error(ErrorCode::non_finite, {"a.exr", "part 'key'", "level 1", "flux.R", "(5,3)"},
                 [&] { write_exr(folder / "a.exr", file); });
    EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
  }
}

TEST(Exr, NonFiniteAttributeIsNeverWritten) {
  const TemporaryFolder folder;
  ExrFile file{{scan_line_part("a", 4, 4)}, "a.exr"};
  file.parts[0].attributes["anchor"] = std::array<double, 3>{0, std::nan(""), 0};
  expect_error(ErrorCode::non_finite, {"a.exr", "'anchor'"}, [&] { write_exr(folder / "a.exr", file); });
}

TEST(Exr, MissingFile) {
  const TemporaryFolder folder;
  expect_error(ErrorCode::file_not_found, {"none.exr"}, [&] { read_exr(folder / "none.exr"); });
  expect_error(ErrorCode::file_not_found, {}, [&] { read_exr(folder / "."); });
}

TEST(Exr, UnwritableFolder) {
  const TemporaryFolder folder;
  const ExrFile file{{scan_line_part("a", 4, 4)}, ""};
  expect_error(ErrorCode::write_failed, {"absent/a.exr"}, [&] { write_exr(folder / "absent/a.exr", file); });
}

TEST(Exr, NotAnExr) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.exr", "P6 1 1 255\nabc");
  expect_error(ErrorCode::exr_unreadable, {"a.exr", "write the file again"},
               [&] { read_exr(folder / "a.exr"); });
  write_bytes(folder / "a.exr", "");
  expect_error(ErrorCode::exr_unreadable, {"a.exr"}, [&] { read_exr(folder / "a.exr"); });
}

TEST(Exr, TruncatedAtEveryKindOfPlace) {
  const TemporaryFolder folder;
  for (const ExrFile& file : {ExrFile{{scan_line_part("a", 40, 40)}, ""},
                              ExrFile{{mip_part("key", 64, 64), scan_line_part("s", 64, 64)}, ""}}) {
    write_exr(folder / "whole.exr", file);
    const std::string whole = bytes_of(folder / "whole.exr");
    // Magic number, header, offset table, pixels; all but the last byte.
    for (std::size_t length : {std::size_t{3}, std::size_t{8}, std::size_t{100}, std::size_t{400},
                               whole.size() / 10, whole.size() / 2, whole.size() - 2000, whole.size() - 1}) {
      write_bytes(folder / "cut.exr", whole.substr(0, length));
      SCOPED_TRACE(length);
      expect_error(ErrorCode::exr_unreadable, {"cut.exr"}, [&] { read_exr(folder / "cut.exr"); });
    }
  }
}

// Where the header keeps the last column and row: behind name, type, length and first corner.
std::size_t data_window_max(const std::string& bytes) {
  const std::string key("dataWindow\0box2i\0", 17);
  return bytes.find(key) + key.size() + 4 + 8;
}

// A header may lie about the size: nothing must be allocated on its word.
TEST(Exr, CorruptSizeIsAnError) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", ExrFile{{scan_line_part("a", 40, 40)}, ""});
  const std::string whole = bytes_of(folder / "a.exr");
  const std::size_t max_x = data_window_max(whole);
  for (std::uint32_t size : {60000u, 16777215u, 2147483647u, 4294967295u}) {
    std::string broken = whole;
    std::memcpy(broken.data() + max_x, &size, 4);
    std::memcpy(broken.data() + max_x + 4, &size, 4);
    write_bytes(folder / "b.exr", broken);
    SCOPED_TRACE(size);
    expect_error(ErrorCode::exr_unreadable, {"b.exr"}, [&] { read_exr(folder / "b.exr"); });
  }
}

TEST(Exr, HeaderThatClaimsMoreThanTheFileHolds) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", ExrFile{{scan_line_part("a", 40, 40)}, ""});
  std::string bytes = bytes_of(folder / "a.exr");
  const std::uint32_t width = 60000;  // 29 MB of pixels in a file of 20 kB
  std::memcpy(bytes.data() + data_window_max(bytes), &width, 4);
  write_bytes(folder / "b.exr", bytes);
  expect_error(ErrorCode::exr_unreadable, {"b.exr", "claims more pixels"},
               [&] { read_exr(folder / "b.exr"); });
}

// A writer that died leaves zeros in the table of offsets.
TEST(Exr, UnfinishedFileIsAnError) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", ExrFile{{scan_line_part("a", 40, 40)}, ""});
  std::string bytes = bytes_of(folder / "a.exr");
  const std::size_t rows = 40 * (8 + 3 * 40 * 4);  // row, length and three channels each
  for (std::size_t i = 1; i <= 8; ++i) bytes[bytes.size() - rows - i] = 0;
  write_bytes(folder / "b.exr", bytes);
  expect_error(ErrorCode::exr_unreadable, {"b.exr", "pixels are missing"},
               [&] { read_exr(folder / "b.exr"); });
}

// Any single corrupt byte of the header region ends in an error of ours or in a readable file, never in a
// crash.
TEST(Exr, CorruptBytesNeverCrash) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", ExrFile{{mip_part("key", 32, 32), scan_line_part("s", 8, 8)}, ""});
  const std::string whole = bytes_of(folder / "a.exr");
  std::mt19937 engine(1);
  int errors = 0;
  for (int i = 0; i < 400; ++i) {
    std::string broken = whole;
    broken[engine() % std::min<std::size_t>(whole.size(), 2500)] = static_cast<char>(engine());
    write_bytes(folder / "b.exr", broken);
    try {
      read_exr(folder / "b.exr");
    } catch (const Error& error) {
      ++errors;
      EXPECT_EQ(error.code(), ErrorCode::exr_unreadable) << error.what();
    }
  }
  EXPECT_GT(errors, 50);
}

TEST(Exr, AccessByNameSaysWhatIsThere) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", ExrFile{{mip_part("key", 16, 16), scan_line_part("s", 8, 8)}, ""});
  const ExrFile file = read_exr(folder / "a.exr");
  const ExrPart& key = file.part("key");
  expect_error(ErrorCode::missing_part, {"a.exr", "'fill'", "'key', 's'"}, [&] { file.part("fill"); });
  expect_error(ErrorCode::missing_part, {"no mip level 5", "has 5"},
               [&] { float_channel(file, key, 5, "flux.R"); });
  expect_error(ErrorCode::missing_channel, {"'key'", "'flux.B'", "flux.G, flux.R, id.I"},
               [&] { float_channel(file, key, 0, "flux.B"); });
  expect_error(ErrorCode::wrong_channel_type, {"'id.I' is UINT but must be FLOAT"},
               [&] { float_channel(file, key, 0, "id.I"); });
  expect_error(ErrorCode::wrong_channel_type, {"level 2", "'flux.R' is FLOAT but must be UINT"},
               [&] { uint_channel(file, key, 2, "flux.R"); });
}

TEST(Exr, AttributesHaveNamesAndTypes) {
  ExrFile file{{scan_line_part("s", 8, 8)}, "a.exr"};
  const ExrPart& part = file.parts[0];
  EXPECT_EQ(int_attribute(file, part, "count"), 42);
  EXPECT_EQ(double_attribute(file, part, "radius"), 1.0 / 3);
  EXPECT_EQ(string_attribute(file, part, "method"), "fis-2016");
  EXPECT_EQ(vec3_attribute(file, part, "anchor")[1], 1e9 + 1e-6);
  EXPECT_EQ(matrix_attribute(file, part, "view")[7], 8);
  expect_error(ErrorCode::missing_attribute, {"a.exr", "'size' (int) is missing"},
               [&] { int_attribute(file, part, "size"); });
  expect_error(ErrorCode::missing_attribute, {"'method' is not of type double"},
               [&] { double_attribute(file, part, "method"); });
}

TEST(Exr, ShapesThatTheFormatCannotHoldAreBugs) {
  const TemporaryFolder folder;
  const auto expect_bug = [&](const ExrFile& file) {
    expect_error(ErrorCode::internal, {"write_exr"}, [&] { write_exr(folder / "a.exr", file); });
  };
  expect_bug(ExrFile{});
  ExrFile missing_level{{mip_part("key", 16, 16)}, ""};
  missing_level.parts[0].levels.pop_back();
  expect_bug(missing_level);
  ExrFile short_plane{{scan_line_part("s", 8, 8)}, ""};
  std::get<0>(short_plane.parts[0].levels[0].channels["flux.R"]).pop_back();
  expect_bug(short_plane);
}

}  // namespace
}  // namespace vsgl
