#include "report/picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../expect_error.h"

namespace vsgl::report {
namespace {

using Names = std::vector<std::string>;
using test::expect_error;

ExrPart part(const std::string& name, int width, int height, const Names& floats, const Names& uints = {}) {
  ExrPart out;
  out.name = name;
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  ExrLevel level{width, height, {}};
  float value = 1;
  for (const std::string& channel : floats) level.channels[channel] = PlaneValues(count, value++);
  for (const std::string& channel : uints) level.channels[channel] = std::vector<std::uint32_t>(count);
  out.levels = {level};
  return out;
}

const Names kChannels = {"depth.Z",    "diffuse.B", "diffuse.G", "diffuse.R", "indirect.B", "indirect.G",
                         "indirect.R", "normal.X",  "normal.Y",  "normal.Z",  "odd.R"};

TEST(Layers, ColoursThenVectorsThenChannels) {
  const ExrFile file{{part("", 2, 2, kChannels, {"id.I"})}, "a.exr"};
  EXPECT_EQ(layer_names(file), (Names{"indirect", "diffuse", "normal", "depth.Z", "odd.R"}));
}

TEST(Layers, ComponentsKeepTheirOrder) {
  const ExrFile file{{part("", 1, 1, {"B", "G", "R", "A"})}, "a.exr"};
  EXPECT_EQ(layer_names(file), (Names{"RGB", "A"}));
  EXPECT_EQ(extract_layer(file, "RGB").planes, (std::vector<PlaneValues>{{3}, {2}, {1}}));
  EXPECT_EQ(extract_layer(file, "A").planes, (std::vector<PlaneValues>{{4}}));
  EXPECT_TRUE(extract_layer(file, "none").planes.empty());
}

TEST(Layers, PartsOfAFileGiveThemNames) {
  const ExrFile file{{part("key", 1, 1, {"flux.R", "flux.G", "flux.B"}), part("fill", 1, 1, {"depth.Z"})},
                     "a.exr"};
  EXPECT_EQ(layer_names(file), (Names{"key: flux", "fill: depth.Z"}));
  EXPECT_EQ(extract_layer(file, "key: flux").planes.size(), 3u);
}

TEST(SharedLayers, ColoursOfOneSizeOrWhatIsSelected) {
  const ExrFile a{{part("", 2, 2, kChannels)}, "a.exr"},
      b{{part("", 2, 2,
              {"indirect.R", "indirect.G", "indirect.B", "normal.X", "normal.Y", "normal.Z", "depth.Z"})},
        "b.exr"};
  const ExrFile small{{part("", 1, 2, kChannels)}, "small.exr"},
      depth{{part("", 2, 2, {"depth.Z"})}, "d.exr"};
  EXPECT_EQ(shared_layers({&a, &b}), Names{"indirect"});
  EXPECT_EQ(shared_layers({&a, &b}, {"normal.X", "depth.Z"}), (Names{"normal", "depth.Z"}));
  EXPECT_EQ(shared_layers({&a, &depth}), Names{"depth.Z"});
  EXPECT_EQ(shared_layers({&a, &small}), Names{});
}

TEST(MakePicture, NamesWhatIsMissing) {
  const ExrFile file{{part("", 2, 2, {"depth.Z"})}, "folder/a.exr"};
  expect_error(ErrorCode::missing_channel, {"folder/a.exr", "no layer \"indirect\"", "it has: depth.Z"},
               [&] { make_picture(file, "A", {"indirect"}); });
  const ExrFile two{{part("p", 2, 2, {"x"}), part("q", 3, 2, {"x"})}, "a.exr"};
  expect_error(ErrorCode::wrong_size, {"\"q: x\" has another size"}, [&] {
    make_picture(two, "A", {"p: x", "q: x"});
  });
}

TEST(MakePicture, CarriesLabelSizeAndOrigin) {
  ExrFile file{{part("", 3, 2, {"depth.Z"})}, "folder/a.exr"};
  file.parts[0].attributes = {{"vsgl.tool", std::string("shade")}, {"vsgl.seed", std::string("7")}};
  const Picture picture = make_picture(file, "A", {"depth.Z"});
  EXPECT_EQ(picture.label, "A");
  EXPECT_EQ(picture.file, "a.exr");
  EXPECT_EQ(std::pair(picture.width, picture.height), std::pair(3, 2));
  EXPECT_EQ(picture.origin,
            (std::vector<std::pair<std::string, std::string>>{{"tool", "shade"}, {"seed", "7"}}));
}

TEST(Exposure, Brings95PercentTo08) {
  PlaneValues ramp;
  for (int i = 1; i <= 100; ++i) ramp.push_back(static_cast<float>(i));
  EXPECT_DOUBLE_EQ(automatic_exposure({"", {ramp}}), std::log2(0.8 / 96));
  EXPECT_EQ(automatic_exposure({"", {PlaneValues{0, -1, std::nanf("")}}}), 0);
}

}  // namespace
}  // namespace vsgl::report
