#include "scene/environment.h"

#include <OpenImageIO/imageio.h>

#include <numbers>

#include "scene/image_codec.h"
#include "scene_fixture.h"

namespace vsgl::test {
namespace {

using scene::Environment;
using scene::EnvironmentSpec;
using scene::FloatImage;

constexpr double pi = std::numbers::pi;

class EnvironmentMap : public ::testing::Test {
 protected:
  // Height x 2 height pixels of the values 1, 2, 3, ... in the channels' order.
  static FloatImage counting(int height, std::vector<std::string> channels = {"R", "G", "B"}) {
    FloatImage image{2 * height, height, std::move(channels), {}};
    const std::size_t count = 2 * static_cast<std::size_t>(height * height) * image.channels.size();
    for (std::size_t i = 0; i < count; ++i) image.values.push_back(static_cast<float>(i + 1));
    return image;
  }
  EnvironmentSpec written(const FloatImage& image) {
    folder.write("map.exr", scene::image_codec().encode_exr(image));
    return {folder / "map.exr", {}, 1};
  }
  void expect_refused(ErrorCode code, const std::vector<std::string>& fragments, const FloatImage& image) {
    const EnvironmentSpec spec = written(image);
    expect_error(code, fragments, [&] { scene::read_environment(spec); });
  }
  SceneFolder folder;
};

void expect_near(Vec3 found, Vec3 expected) {
  EXPECT_LT(length(found - expected), 1e-12) << found.x << " " << found.y << " " << found.z;
}

TEST_F(EnvironmentMap, TopIsUpAndTheMiddleIsZ) {
  expect_near(scene::environment_direction(0.3, 0), {0, 1, 0});
  expect_near(scene::environment_direction(0.3, 1), {0, -1, 0});
  expect_near(scene::environment_direction(0.5, 0.5), {0, 0, 1});
  expect_near(scene::environment_direction(0.25, 0.5), {1, 0, 0});
  expect_near(scene::environment_direction(0.75, 0.5), {-1, 0, 0});
  expect_near(scene::environment_direction(0, 0.5), {0, 0, -1});
  expect_near(scene::environment_direction(1, 0.5), {0, 0, -1});
}

TEST_F(EnvironmentMap, TexelsCoverTheSphere) {
  Environment map;
  for (const int height : {1, 2, 7, 32}) {
    map.height = height, map.width = 2 * height;
    double whole = 0;
    Vec3 sum;
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < map.width; ++column) {
        const auto texel = scene::environment_texel(map, column, row);
        whole += texel.solid_angle;
        sum += texel.mean * texel.solid_angle;
        const Vec3 middle = scene::environment_direction((column + 0.5) / map.width, (row + 0.5) / height);
        EXPECT_GT(dot(normalise(texel.mean), middle), height > 2 ? 0.9 : 0.5);
        EXPECT_LT(length(texel.mean), 1);
      }
    EXPECT_NEAR(whole, 4 * pi, 1e-12);
    expect_near(sum, {});
  }
}

// The mean of many directions inside a texel, each weighted by its share of the area.
TEST_F(EnvironmentMap, MeanDirectionAgainstQuadrature) {
  const Environment map{12, 6, {}, {}};
  const int n = 400;
  Vec3 sum;
  double weight = 0;
  for (int i = 0; i < n * n; ++i) {
    const double u = (2 + (i % n + 0.5) / n) / 12, v = (1 + (i / n + 0.5) / n) / 6;
    const double area = std::sin(pi * v);
    sum += scene::environment_direction(u, v) * area;
    weight += area;
  }
  const auto texel = scene::environment_texel(map, 2, 1);
  EXPECT_LT(length(texel.mean - sum / weight), 1e-6);
  EXPECT_NEAR(texel.solid_angle, weight / (n * n) * (pi / 6) * (pi / 6), 1e-6);
}

TEST_F(EnvironmentMap, ReadsExrWithScaleAndRotation) {
  EnvironmentSpec spec = written(counting(2, {"R", "G", "B", "A"}));
  spec.scale = 0.5;
  spec.rotation_deg = {0, 90, 0};
  const Environment map = scene::read_environment(spec);
  EXPECT_EQ(map.width, 4);
  EXPECT_EQ(map.at(0, 0), (Vec3{0.5, 1, 1.5}));
  EXPECT_EQ(map.at(1, 1), (Vec3{10.5, 11, 11.5}));  // the sixth pixel
  expect_near(map.rotation.direction({0, 0, 1}), {1, 0, 0});
}

TEST_F(EnvironmentMap, ReadsRadianceHdr) {
  const auto path = (folder / "map.hdr").string();
  const auto output = OIIO::ImageOutput::create(path);
  const std::vector<float> values{1, 2, 4, 0.5f, 0.25f, 0};
  ASSERT_TRUE(output && output->open(path, OIIO::ImageSpec(2, 1, 3, OIIO::TypeDesc::FLOAT)) &&
              output->write_image(OIIO::TypeDesc::FLOAT, values.data()) && output->close());
  const Environment map = scene::read_environment({path, {}, 1});
  EXPECT_LT(length(map.at(0, 0) - Vec3{1, 2, 4}), 0.05);
  EXPECT_LT(length(map.at(1, 0) - Vec3{0.5, 0.25, 0}), 0.01);
}

TEST_F(EnvironmentMap, BadMapsAreRefused) {
  FloatImage map = counting(2);
  map.values[7] = std::numeric_limits<float>::quiet_NaN();  // channel G of the third pixel
  expect_refused(ErrorCode::non_finite, {"map.exr", "channel G", "2, 0"}, map);
  map.values[7] = std::numeric_limits<float>::infinity();
  expect_refused(ErrorCode::non_finite, {"channel G"}, map);
  map.values[7] = -1;
  expect_refused(ErrorCode::invalid_data, {"channel G", "2, 0", "-1"}, map);
  map.values.assign(map.values.size(), 0);
  expect_refused(ErrorCode::bad_light, {"map.exr", "black"}, map);
  FloatImage square = counting(2);
  square.width = square.height = 2;
  expect_refused(ErrorCode::wrong_size, {"2x2", "twice as wide"}, square);
  expect_refused(ErrorCode::missing_channel, {"Y", "R, G and B"}, counting(2, {"Y"}));
  expect_refused(ErrorCode::missing_channel, {"X, Y, Z"}, counting(2, {"X", "Y", "Z"}));
  folder.write("map.exr", "not an image");
  expect_error(ErrorCode::texture_unreadable, {"map.exr"}, [&] {
    scene::read_environment({folder / "map.exr", {}, 1});
  });
  expect_error(ErrorCode::file_not_found, {"absent.exr"}, [&] {
    scene::read_environment({folder / "absent.exr", {}, 1});
  });
  folder.write("map.ppm", std::string("P6\n2 1\n255\n", 11) + "abcdef");
  expect_error(ErrorCode::wrong_channel_type, {"map.ppm", "integers"}, [&] {
    scene::read_environment({folder / "map.ppm", {}, 1});
  });
}

TEST_F(EnvironmentMap, SceneNamesIt) {
  folder.write_json("mesh.gltf", triangle_gltf(folder));
  const Json environment{{"file", "map.exr"}, {"rotation_deg", {1, 2, 3}}, {"scale", 4}};
  const auto scene = folder.load({{"environment", environment}, {"lights", Json::array()}});
  ASSERT_TRUE(scene.environment);
  EXPECT_EQ(*scene.environment, (EnvironmentSpec{folder / "map.exr", {1, 2, 3}, 4}));
  EXPECT_TRUE(scene.lights.empty());  // the environment is light enough
  EXPECT_EQ(scene::scene_files(folder / "scene.json").back(), folder / "map.exr");
  expect_error(ErrorCode::json_missing_key, {"/environment", "file"}, [&] {
    folder.load({{"environment", Json::object()}});
  });
  expect_error(ErrorCode::json_out_of_range, {"/environment/scale"}, [&] {
    folder.load({{"environment", {{"file", "map.exr"}, {"scale", -1}}}});
  });
}

}  // namespace
}  // namespace vsgl::test
