#include "stages/metrics/pictures.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "../expect_error.h"

namespace vsgl::metrics {
namespace {

using test::expect_error;
using test::TemporaryFolder;

using Rgb = std::array<std::uint8_t, 3>;

double linear(std::uint8_t encoded) {
  const double x = encoded / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}
// CIE lightness of an sRGB colour.
double lightness(const Rgb& c) {
  const double y = 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}
Rgb pixel(const Picture& p, int x, int y) {
  const std::size_t i = 3 * static_cast<std::size_t>(y * p.width + x);
  return {p.rgb[i], p.rgb[i + 1], p.rgb[i + 2]};
}

// 2x2, "indirect" grey of the given values, and a layer that sorts before it.
ExrFile file_of(const std::vector<float>& values) {
  ExrPart part;
  ExrLevel level{2, 2, {}};
  for (const char* c : {"indirect.R", "indirect.G", "indirect.B"}) level.channels[c] = values;
  for (const char* c : {"diffuse.R", "diffuse.G", "diffuse.B"})
    level.channels[c] = std::vector<float>(4, 1.0f);
  level.channels["depth.Z"] = std::vector<float>(4, 7.0f);
  level.channels["id.I"] = std::vector<std::uint32_t>(4, 3);
  part.levels = {level};
  return {{part}, "x.exr"};
}

TEST(ColourMap, LightnessRisesEvenly) {
  const double first = lightness(map_colour(0)), last = lightness(map_colour(1));
  EXPECT_LT(first, 10);
  EXPECT_GT(last, 90);
  for (int i = 0; i <= 20; ++i) {
    const double t = i / 20.0;
    EXPECT_NEAR(lightness(map_colour(t)), first + t * (last - first), 12) << t;
  }
  for (int i = 1; i <= 20; ++i)
    EXPECT_GT(lightness(map_colour(i / 20.0)), lightness(map_colour((i - 1) / 20.0)) + 1) << i;
  EXPECT_EQ(map_colour(-1), map_colour(0));
  EXPECT_EQ(map_colour(2), map_colour(1));
}

TEST(FalseColour, ScaleIsLogarithmic) {
  // Reference 1 everywhere: the regularisation is 0.01.
  const auto layer =
      choose_layer(file_of({1, 1 + 1.01f, 1 + 0.0101f, 1 - 1.01e-4f}), file_of({1, 1, 1, 1}), "");
  ASSERT_TRUE(layer);
  const Picture picture = false_colour(*layer);
  EXPECT_EQ(pixel(picture, 0, 0), map_colour(0));
  EXPECT_EQ(pixel(picture, 1, 0), map_colour(1));
  const auto near = [](const Rgb& a, const Rgb& b) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 2);
  };
  near(pixel(picture, 0, 1), map_colour(0.5));
  near(pixel(picture, 1, 1), map_colour(0));
}

TEST(FalseColour, NonFinitePixelsAreGreen) {
  const auto layer = choose_layer(file_of({1, std::nanf(""), HUGE_VALF, 1}), file_of({1, 1, 1, 1}), "");
  const Picture picture = false_colour(*layer);
  EXPECT_EQ(pixel(picture, 1, 0), (Rgb{0, 255, 0}));
  EXPECT_EQ(pixel(picture, 0, 1), (Rgb{0, 255, 0}));
  EXPECT_EQ(pixel(picture, 1, 1), map_colour(0));
}

TEST(ChooseLayer, Preference) {
  const ExrFile file = file_of({1, 2, 3, 4});
  EXPECT_EQ(choose_layer(file, file, "")->name, "indirect");
  EXPECT_EQ(choose_layer(file, file, "diffuse")->name, "diffuse");
  EXPECT_EQ(choose_layer(file, file, "depth.Z")->test[3][1], 7.0f);
  ExrFile other = file;
  for (const char* c : {"indirect.R", "indirect.G", "indirect.B"}) other.parts[0].levels[0].channels.erase(c);
  EXPECT_EQ(choose_layer(other, file, "")->name, "diffuse");
  for (const char* c : {"diffuse.R", "diffuse.G"}) other.parts[0].levels[0].channels.erase(c);
  EXPECT_EQ(choose_layer(other, file, "")->name, "depth.Z");
  expect_error(ErrorCode::bad_value, {"--layer normal"}, [&] { choose_layer(file, file, "normal"); });
  other = file;
  other.parts[0].levels[0].width = 4;
  EXPECT_FALSE(choose_layer(other, file, ""));
}

TEST(SideBySide, ExposureAndOrder) {
  const auto layer = choose_layer(file_of({0.25f, 0, 0, 0}), file_of({0.5f, 0.5f, 0.5f, 0.5f}), "");
  EXPECT_NEAR(automatic_exposure(*layer), std::log2(0.8 / 0.5), 1e-6);
  const Picture picture = side_by_side(*layer, 1);
  EXPECT_EQ(picture.width, 6);
  EXPECT_EQ(picture.height, 2);
  EXPECT_NEAR(linear(pixel(picture, 0, 0)[1]), 0.5, 0.005);
  EXPECT_EQ(pixel(picture, 1, 0), (Rgb{0, 0, 0}));
  EXPECT_EQ(pixel(picture, 2, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(pixel(picture, 5, 1), pixel(false_colour(*layer), 1, 1));
}

TEST(ErrorMap, HoldsAbsoluteErrors) {
  ExrFile a = file_of({1, 5, 3, std::nanf("")}), b = file_of({2, 2, 3, 4});
  std::get<1>(a.parts[0].levels[0].channels["id.I"])[1] = 9;
  Options options;
  options.exclude = {"depth"};
  const ExrFile map = *error_map(a, b, options);
  EXPECT_EQ(float_channel(map, map.parts[0], 0, "indirect.G"), (std::vector<float>{1, 3, 0, -1}));
  EXPECT_EQ(float_channel(map, map.parts[0], 0, "id.I"), (std::vector<float>{0, 1, 0, 0}));
  EXPECT_FALSE(has_channel(map.parts[0], "depth.Z"));
  EXPECT_NO_THROW(check_finite(map));
}

TEST(ErrorMap, LeavesOutWhatDoesNotFit) {
  ExrFile a = file_of({1, 1, 1, 1}), b = a;
  a.parts[0].levels[0].height = 1;
  EXPECT_FALSE(error_map(a, b, Options{}));
}

TEST(Png, RoundTripAndEqualBytes) {
  const TemporaryFolder folder;
  const Picture picture{2, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 250, 251, 252}};
  write_png(folder / "a.png", picture);
  write_png(folder / "b.png", picture);
  const auto in = OIIO::ImageInput::open((folder / "a.png").string());
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().nchannels, 3);
  std::vector<std::uint8_t> back(12);
  ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, back.data()));
  EXPECT_EQ(back, picture.rgb);
  const auto bytes = [&](const char* name) {
    std::ifstream file(folder / name, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  EXPECT_TRUE(bytes("a.png") == bytes("b.png"));
  expect_error(ErrorCode::write_failed, {"absent/a.png"},
               [&] { write_png(folder / "absent/a.png", picture); });
}

}  // namespace
}  // namespace vsgl::metrics
