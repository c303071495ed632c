#include "stages/metrics/pictures.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "stages/metrics/colour.h"

namespace vsgl::metrics {
namespace {

std::uint8_t encode(double linear) {
  return static_cast<std::uint8_t>(std::lround(255 * encode_srgb(linear)));
}

// [Ottosson 2020] Oklab to linear sRGB.
std::array<double, 3> oklab_to_linear(double lightness, double a, double b) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

void put(Picture& picture, int x, int y, const std::array<std::uint8_t, 3>& colour) {
  const std::size_t index = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                 static_cast<std::size_t>(x));
  std::copy(colour.begin(), colour.end(), picture.rgb.begin() + static_cast<std::ptrdiff_t>(index));
}

Picture blank(int width, int height) {
  return {width, height,
          std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
}

}  // namespace

std::array<std::uint8_t, 3> map_colour(double t) {
  // Oklab (lightness, a, b) at equal steps of lightness; inside the sRGB gamut along the whole way.
  static constexpr double kTable[5][3] = {{0.16, 0.005, -0.030},
                                          {0.36, 0.055, -0.118},
                                          {0.56, 0.187, -0.033},
                                          {0.76, 0.100, 0.105},
                                          {0.96, -0.026, 0.097}};
  const double place = 4 * std::clamp(t, 0.0, 1.0);
  const int k = std::min(3, static_cast<int>(place));
  double lab[3];
  for (int c = 0; c < 3; ++c) lab[c] = kTable[k][c] + (place - k) * (kTable[k + 1][c] - kTable[k][c]);
  const std::array<double, 3> rgb = oklab_to_linear(lab[0], lab[1], lab[2]);
  return {encode(rgb[0]), encode(rgb[1]), encode(rgb[2])};
}

Picture false_colour(const LayerPair& layer) {
  static constexpr std::array<std::uint8_t, 3> kNotFinite = {0, 255, 0};
  double sum = 0;
  std::size_t count = 0;
  for (const Colour& c : layer.reference) {
    const double b = std::abs(luminance_of(c));
    if (!std::isfinite(b)) continue;
    sum += b;
    ++count;
  }
  const double floor = count == 0 || sum == 0 ? 1e-30 : 0.01 * sum / static_cast<double>(count);
  Picture out = blank(layer.width, layer.height);
  for (std::size_t i = 0; i < layer.reference.size(); ++i) {
    const double a = luminance_of(layer.test[i]), b = luminance_of(layer.reference[i]);
    const double relative = std::abs(a - b) / (std::abs(b) + floor);
    const double t = relative > 0 ? (std::log10(relative) + 4) / 4 : 0;
    const auto colour = std::isfinite(relative) ? map_colour(t) : kNotFinite;
    std::copy(colour.begin(), colour.end(), out.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  return out;
}

Picture side_by_side(const LayerPair& layer, double exposure) {
  const double scale = std::exp2(exposure);
  const Picture error = false_colour(layer);
  Picture out = blank(3 * layer.width, layer.height);
  const auto tone = [&](const Colour& c) -> std::array<std::uint8_t, 3> {
    std::array<std::uint8_t, 3> rgb;
    for (std::size_t k = 0; k < 3; ++k)
      rgb[k] = std::isnan(c[k]) ? 0 : encode(scale * static_cast<double>(c[k]));
    return rgb;
  };
  for (int y = 0; y < layer.height; ++y)
    for (int x = 0; x < layer.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(layer.width) + static_cast<std::size_t>(x);
      put(out, x, y, tone(layer.test[i]));
      put(out, x + layer.width, y, tone(layer.reference[i]));
      put(out, x + 2 * layer.width, y, {error.rgb[3 * i], error.rgb[3 * i + 1], error.rgb[3 * i + 2]});
    }
  return out;
}

void write_png(const std::filesystem::path& path, const Picture& picture) {
  const auto fail = [&](const std::string& why) {
    throw Error(ErrorCode::write_failed,
                path.string() + ": cannot be written (" + why + "); check the folder and the disk");
  };
  const auto out = OIIO::ImageOutput::create(path.string());
  if (!out) fail(OIIO::geterror());
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (!out->open(path.string(), spec) || !out->write_image(OIIO::TypeDesc::UINT8, picture.rgb.data()) ||
      !out->close())
    fail(out->geterror());
}

}  // namespace vsgl::metrics
