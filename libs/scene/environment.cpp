#include "scene/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "scene/image_codec.h"
#include "scene/transform.h"

namespace vsgl::scene {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double max_radiance = 1e30;  // W/(m^2 sr)

void check_shape(const FloatImage& image, const std::string& name) {
  if (image.width != 2 * image.height)
    throw Error(ErrorCode::wrong_size, name + ": " + std::to_string(image.width) + "x" +
                                           std::to_string(image.height) +
                                           " pixels; a latitude-longitude map is twice as wide as high");
  const std::vector<std::string>& channels = image.channels;
  const bool colour = channels.size() == 3 || (channels.size() == 4 && channels[3] == "A");
  if (colour && channels[0] == "R" && channels[1] == "G" && channels[2] == "B") return;
  std::string found;
  for (const std::string& channel : channels) found += (found.empty() ? "" : ", ") + channel;
  throw Error(ErrorCode::missing_channel,
              name + ": channels " + found + "; an environment map has R, G and B, and perhaps A");
}

[[noreturn]] void bad_radiance(const FloatImage& image, const std::string& name, std::size_t index,
                               double value) {
  const std::size_t channels = image.channels.size(), pixel = index / channels;
  const auto width = static_cast<std::size_t>(image.width);
  const std::string where = name + ": channel " + image.channels[index % channels] + " at pixel " +
                            std::to_string(pixel % width) + ", " + std::to_string(pixel / width) + ": ";
  if (!std::isfinite(value)) throw Error(ErrorCode::non_finite, where + "NaN or infinite; mend the map");
  throw Error(ErrorCode::invalid_data, where + "radiance " + std::to_string(value) +
                                           " is outside 0..1e30; mend the map, or change its scale");
}

// Integral of (sin, cos) over an interval about `middle`.
struct Arc {
  double sine, cosine;
};
Arc integrate_arc(double middle, double width) {
  const double chord = 2 * std::sin(width / 2);
  return {chord * std::sin(middle), chord * std::cos(middle)};
}

}  // namespace

Environment read_environment(const EnvironmentSpec& spec) {
  const std::string name = spec.file.string();
  const FloatImage image = image_codec().read_float(spec.file);
  check_shape(image, name);
  Environment out{image.width, image.height, {}, rotation_xyz_deg(spec.rotation_deg)};
  const std::size_t channels = image.channels.size();
  const auto radiance = [&](std::size_t index) {
    const double value = spec.scale * static_cast<double>(image.values[index]);
    if (!(value >= 0 && value <= max_radiance)) bad_radiance(image, name, index, value);
    return value;
  };
  out.radiance.reserve(image.values.size() / channels);
  for (std::size_t i = 0; i < image.values.size(); i += channels)
    out.radiance.push_back({radiance(i), radiance(i + 1), radiance(i + 2)});
  if (std::all_of(out.radiance.begin(), out.radiance.end(), [](Vec3 l) { return l == Vec3{}; }))
    throw Error(ErrorCode::bad_light, name + ": the environment map is black; choose another one");
  return out;
}

Vec3 environment_direction(double u, double v) {
  const double longitude = pi * (1 - 2 * u), polar = pi * v;
  return {std::sin(longitude) * std::sin(polar), std::cos(polar), std::cos(longitude) * std::sin(polar)};
}

Vec3 radiance_from(const Environment& environment, Vec3 direction) {
  const Mat4& r = environment.rotation;
  const auto back = [&](int column) {
    return r.m[0][column] * direction.x + r.m[1][column] * direction.y + r.m[2][column] * direction.z;
  };
  const double u = 0.5 * (1 - std::atan2(back(0), back(2)) / pi),
               v = std::acos(std::clamp(back(1), -1.0, 1.0)) / pi;
  return environment.at(std::clamp(static_cast<int>(u * environment.width), 0, environment.width - 1),
                        std::clamp(static_cast<int>(v * environment.height), 0, environment.height - 1));
}

// Integrals over the texel in closed form: of 1, cos and sin times the area element sin(polar).
EnvironmentTexel environment_texel(const Environment& environment, int column, int row) {
  const double step = pi / environment.height;
  const double polar = (row + 0.5) * step, longitude = pi * (1 - (2 * column + 1.0) / environment.width);
  const Arc ring = integrate_arc(polar, step);  // sine: of sin(polar)
  const Arc twice = integrate_arc(2 * polar, 2 * step);
  const double sine_squared = 0.5 * step - 0.25 * twice.cosine, sine_cosine = 0.25 * twice.sine;
  const Arc turn = integrate_arc(longitude, step);
  EnvironmentTexel out;
  out.solid_angle = step * ring.sine;
  out.mean = Vec3{sine_squared * turn.sine, sine_cosine * step, sine_squared * turn.cosine} / out.solid_angle;
  return out;
}

}  // namespace vsgl::scene
