#include "scene/texture.h"

#include <OpenImageIO/imageio.h>

#include <limits>

#include "scene_fixture.h"

namespace vsgl::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

class Textures : public ::testing::Test {
 protected:
  // Writes one row of pixels and reads it back as a texture.
  template <typename T>
  Bytes round_trip(const std::string& name, int channels, OIIO::TypeDesc type, const std::vector<T>& values) {
    const auto path = folder / name;
    const auto output = OIIO::ImageOutput::create(path.string());
    OIIO::ImageSpec spec(static_cast<int>(values.size()) / channels, 1, channels, type);
    spec["oiio:UnassociatedAlpha"] = 1;
    EXPECT_TRUE(output && output->open(path.string(), spec) && output->write_image(type, values.data()) &&
                output->close());
    return scene::read_texture(path, false).rgba;
  }
  SceneFolder folder;
};

TEST_F(Textures, ChannelsBecomeRgba) {
  const auto type = OIIO::TypeDesc::UINT8;
  EXPECT_EQ(round_trip<std::uint8_t>("grey.png", 1, type, {10, 200}),
            (Bytes{10, 10, 10, 255, 200, 200, 200, 255}));
  EXPECT_EQ(round_trip<std::uint8_t>("grey-alpha.png", 2, type, {10, 20}), (Bytes{10, 10, 10, 20}));
  EXPECT_EQ(round_trip<std::uint8_t>("rgb.png", 3, type, {1, 2, 3}), (Bytes{1, 2, 3, 255}));
  // Alpha must not darken the colour.
  EXPECT_EQ(round_trip<std::uint8_t>("rgba.png", 4, type, {200, 100, 50, 51}), (Bytes{200, 100, 50, 51}));
  EXPECT_EQ(round_trip<std::uint16_t>("deep.png", 1, OIIO::TypeDesc::UINT16, {65535}),
            (Bytes{255, 255, 255, 255}));
}

// 8 bits hold neither NaN nor more than 1: nothing of that may become some colour unseen.
TEST_F(Textures, FloatsOutOfRangeAreRefused) {
  const auto type = OIIO::TypeDesc::FLOAT;
  EXPECT_EQ(round_trip<float>("fine.exr", 3, type, {0, 1, 0.2f}), (Bytes{0, 255, 51, 255}));
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1.5f, -0.1f})
    expect_error(ErrorCode::texture_unreadable, {"bad.exr", "(1,0)"}, [&] {
      round_trip<float>("bad.exr", 3, type, {0, 0, 0, 0, bad, 0});
    });
}

// (3, 4) / 5 at half its length, (1, 0, 0) rounded, and nothing at all.
TEST(NormalMaps, BecomeUnit) {
  scene::Texture map{"map", 3, 1, false, {166, 179, 128, 9, 255, 128, 127, 9, 128, 127, 128, 9}};
  EXPECT_DOUBLE_EQ(scene::normalise_normal_map(map), 2.0 / 3);
  EXPECT_EQ(map.rgba, (Bytes{204, 230, 128, 9, 255, 128, 127, 9, 128, 128, 255, 9}));
  EXPECT_EQ(scene::normalise_normal_map(map), 0);
}

TEST_F(Textures, FromMemory) {
  round_trip<std::uint8_t>("rgb.png", 3, OIIO::TypeDesc::UINT8, {9, 8, 7, 6, 5, 4});
  std::ifstream file(folder / "rgb.png", std::ios::binary);
  const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), {}};
  const scene::Texture texture = scene::read_texture(bytes, "png", "inside", true);
  EXPECT_EQ(texture.name, "inside");
  EXPECT_TRUE(texture.srgb);
  EXPECT_EQ(texture.width, 2);
  EXPECT_EQ(texture.rgba, (Bytes{9, 8, 7, 255, 6, 5, 4, 255}));
  const std::vector<unsigned char> garbage(100, 'x');
  expect_error(ErrorCode::texture_unreadable, {"inside"},
               [&] { scene::read_texture(garbage, "png", "inside", true); });
}

TEST_F(Textures, EmbeddedInGltf) {
  round_trip<std::uint8_t>("rgb.png", 3, OIIO::TypeDesc::UINT8, {9, 8, 7});
  std::ifstream file(folder / "rgb.png", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  folder.write("image.bin", bytes);
  Json gltf = triangle_gltf(folder, true);
  gltf["buffers"].push_back({{"uri", "image.bin"}, {"byteLength", bytes.size()}});
  gltf["bufferViews"].push_back({{"buffer", 1}, {"byteLength", bytes.size()}});
  gltf["images"] = {{{"bufferView", 4}, {"mimeType", "image/png"}}};
  gltf["textures"] = {{{"source", 0}}};
  gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  folder.write_json("mesh.gltf", gltf);
  const scene::Scene scene = folder.load(Json::object());
  ASSERT_EQ(scene.materials[0].base_color_texture, 0);
  EXPECT_EQ(scene.textures[0].rgba, (Bytes{9, 8, 7, 255}));
  EXPECT_TRUE(scene.textures[0].srgb);
}

}  // namespace
}  // namespace vsgl::test
