#include "scene/texture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cmath>

#include "base/error.h"

namespace vsgl::scene {
namespace {

constexpr int max_side = 16384;

[[noreturn]] void unreadable(const std::string& name, const std::string& why) {
  throw Error(ErrorCode::texture_unreadable, name + ": " + why);
}

Texture convert(OIIO::ImageInput& input, const std::string& name, bool srgb) {
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.width > max_side ||
      spec.height > max_side) {
    unreadable(name, "a texture must have 1 to 16384 pixels a side");
  }
  const int channels = std::min(spec.nchannels, 4);
  const std::size_t pixels = static_cast<std::size_t>(spec.width) * spec.height;
  std::vector<std::uint8_t> values(pixels * channels);
  if (!input.read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, values.data())) {
    unreadable(name, "the image is damaged: " + input.geterror());
  }
  Texture out{name, spec.width, spec.height, srgb, std::vector<std::uint8_t>(pixels * 4, 255)};
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint8_t* from = &values[i * channels];
    std::uint8_t* to = &out.rgba[i * 4];
    const bool grey = channels < 3;
    for (int c = 0; c < 3; ++c) to[c] = from[grey ? 0 : c];
    if (channels == 2 || channels == 4) to[3] = from[channels - 1];
  }
  return out;
}

// Alpha is coverage for the cut-out test and must not darken the colour.
OIIO::ImageSpec unassociated_alpha() {
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  return config;
}

}  // namespace

Texture read_texture(const std::filesystem::path& path, bool srgb) {
  if (!std::filesystem::is_regular_file(path)) unreadable(path.string(), "the image file is missing");
  const OIIO::ImageSpec config = unassociated_alpha();
  const auto input = OIIO::ImageInput::open(path.string(), &config);
  if (!input) unreadable(path.string(), "not a readable image: " + OIIO::geterror());
  return convert(*input, path.string(), srgb);
}

Texture read_texture(std::span<const unsigned char> bytes, const std::string& format, const std::string& name,
                     bool srgb) {
  OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(bytes.data()), bytes.size());  // only read
  // Not ImageInput::open(), which in OpenImageIO 2.4 forgets the memory when it is given a configuration.
  const auto input = OIIO::ImageInput::create(format);
  if (!input) unreadable(name, "images of the format \"" + format + "\" are not supported");
  OIIO::ImageSpec spec;
  if (!input->set_ioproxy(&memory) || !input->open("embedded." + format, spec, unassociated_alpha())) {
    unreadable(name, "not a readable image: " + input->geterror());
  }
  return convert(*input, name, srgb);
}

void Texture::require_whole() const {
  const std::size_t expected =
      std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (expected != 0 && rgba.size() == expected) return;
  throw Error(ErrorCode::texture_unreadable, "texture \"" + name + "\": " + std::to_string(rgba.size()) +
                                                 " bytes for " + std::to_string(width) + "x" +
                                                 std::to_string(height) + " texels");
}

double normalise_normal_map(Texture& texture) {
  constexpr double rounding = 0.0075;  // of a unit vector's length, at most sqrt(3) / 255
  std::size_t changed = 0;
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
    std::uint8_t* texel = &texture.rgba[i];
    const Vec3 m{2 * texel[0] / 255.0 - 1, 2 * texel[1] / 255.0 - 1, 2 * texel[2] / 255.0 - 1};
    const double norm = length(m);
    if (std::abs(norm - 1) <= rounding) continue;
    const Vec3 unit = norm > 0.01 ? m / norm : Vec3{0, 0, 1};
    const double components[] = {unit.x, unit.y, unit.z};
    for (int c = 0; c < 3; ++c)
      texel[c] = static_cast<std::uint8_t>(std::lround(255 * (components[c] + 1) / 2));
    ++changed;
  }
  return 4 * static_cast<double>(changed) / static_cast<double>(texture.rgba.size());
}

int TexturePool::add(const std::filesystem::path& path, bool srgb) {
  const std::filesystem::path plain = path.lexically_normal();
  return add(plain.string(), srgb, [&] { return read_texture(plain, srgb); });
}

}  // namespace vsgl::scene
