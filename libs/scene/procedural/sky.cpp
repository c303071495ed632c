#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/environment.h"
#include "scene/image_codec.h"
#include "scene/procedural/generators.h"
#include "scene/procedural/shapes.h"

namespace vsgl::scene {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int map_height = 128, samples = 4;                     // a side of a pixel, for the sun's edge
constexpr Vec3 zenith{0.25, 0.5, 1.1}, horizon{1.1, 1.1, 1.05};  // W/(m^2 sr)
constexpr Vec3 ground{0.12, 0.11, 0.1}, sun{900, 800, 600};
constexpr double sun_radius = 2.5 * pi / 180;  // ten times the true sun's: some pixels wide

// Behind the camera and to its left.
Vec3 sun_direction() {
  return normalise({-0.5, 0.6, 0.6});
}

// A gradient from the horizon to the zenith, a sun with a sharp edge, and an even ground.
Vec3 sky_radiance(Vec3 direction) {
  if (direction.y < 0) return ground;
  if (dot(direction, sun_direction()) > std::cos(sun_radius)) return sun;
  const double up = std::sqrt(direction.y);
  return horizon * (1 - up) + zenith * up;
}

}  // namespace

std::string environment_exr(const std::function<Vec3(Vec3)>& radiance) {
  FloatImage map{2 * map_height, map_height, {"R", "G", "B"}, {}};
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      Vec3 mean;
      for (int k = 0; k < samples * samples; ++k) {
        const double x = column + (k % samples + 0.5) / samples, y = row + (k / samples + 0.5) / samples;
        mean += radiance(environment_direction(x / map.width, y / map.height)) / (samples * samples);
      }
      for (const double value : to_array(mean)) map.values.push_back(static_cast<float>(value));
    }
  return image_codec().encode_exr(map);
}

// Metal balls from smooth to rough and a matt block on a matt ground, under a sky whose map lies beside the
// scene. The lamp is for the chains that do without the sky.
Model make_sky(const GenerateOptions& options) {
  const auto [alpha, ndf] = chosen_lobe(options, 0.02);
  Model model;
  const int matt = model.add_material({"matt", {0.5, 0.5, 0.5}, {}});
  const int red = model.add_material({"red", {0.6, 0.15, 0.1}, {}});
  Shapes floor("ground", matt), block("block", red);
  floor.quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4});
  block.box({-0.3, 0, -1.5}, {0.3, 1.2, -0.9}, "xXYzZ");
  model.add(floor.take());
  model.add(block.take());
  for (int i = 0; i < 3; ++i) {
    const double roughness = std::min(alpha * std::pow(4, i), 1.0);
    const std::string name = "ball" + std::to_string(i + 1);
    const int metal = model.add_material({name, {0.9, 0.85, 0.75}, {}, true, roughness, ndf});
    model.add(ball(name, metal, {-1.1 + 1.1 * i, 0.45, 0}, 0.45));
  }
  model.camera = {{0, 1.3, 4.2}, {0, 0.45, 0}, 38};
  model.light = {{2.5, 3, 2.5}, {0, 0, 0}, 25};
  model.light_inner_deg = 15;
  model.light_intensity_w_sr = 20;
  model.images = {{"sky.exr", environment_exr(sky_radiance)}};
  model.environment = "sky.exr";
  return model;
}

}  // namespace vsgl::scene
