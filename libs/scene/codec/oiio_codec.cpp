#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "base/error.h"
#include "scene/image_codec.h"

namespace vsgl::scene {
namespace {

constexpr int max_side = 16384;

[[noreturn]] void unreadable(const std::string& name, const std::string& why) {
  throw Error(ErrorCode::texture_unreadable, name + ": " + why);
}

// Images of floats may hold what 8 bits cannot: NaN, infinities, values outside 0..1.
void require_in_range(OIIO::ImageInput& input, int channels, const std::string& name) {
  const OIIO::ImageSpec& spec = input.spec();
  if (!spec.format.is_floating_point()) return;
  std::vector<float> values(static_cast<std::size_t>(spec.width) * spec.height * channels);
  if (!input.read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data()))
    unreadable(name, "the image is damaged: " + input.geterror());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= 0 && values[i] <= 1) continue;
    const std::size_t pixel = i / channels;
    unreadable(name, "the value " + std::to_string(values[i]) + " at (" + std::to_string(pixel % spec.width) +
                         "," + std::to_string(pixel / spec.width) + ") is outside 0..1; correct the image");
  }
}

Texture convert(OIIO::ImageInput& input, const std::string& name, bool srgb) {
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.width > max_side ||
      spec.height > max_side) {
    unreadable(name, "a texture must have 1 to 16384 pixels a side");
  }
  const int channels = std::min(spec.nchannels, 4);
  const std::size_t pixels = static_cast<std::size_t>(spec.width) * spec.height;
  require_in_range(input, channels, name);
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

class OiioCodec final : public ImageCodec {
 public:
  Texture read(const std::filesystem::path& path, bool srgb) const override {
    if (!std::filesystem::is_regular_file(path)) unreadable(path.string(), "the image file is missing");
    const OIIO::ImageSpec config = unassociated_alpha();
    const auto input = OIIO::ImageInput::open(path.string(), &config);
    if (!input) unreadable(path.string(), "not a readable image: " + OIIO::geterror());
    return convert(*input, path.string(), srgb);
  }

  Texture read(std::span<const unsigned char> bytes, const std::string& format, const std::string& name,
               bool srgb) const override {
    OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(bytes.data()),
                                         bytes.size());  // only read
    // Not ImageInput::open(), which in OpenImageIO 2.4 forgets the memory when it is given a configuration.
    const auto input = OIIO::ImageInput::create(format);
    if (!input) unreadable(name, "images of the format \"" + format + "\" are not supported");
    OIIO::ImageSpec spec;
    if (!input->set_ioproxy(&memory) || !input->open("embedded." + format, spec, unassociated_alpha())) {
      unreadable(name, "not a readable image: " + input->geterror());
    }
    return convert(*input, name, srgb);
  }

  FloatImage read_float(const std::filesystem::path& path) const override {
    const std::string name = path.string();
    if (!std::filesystem::is_regular_file(path))
      throw Error(ErrorCode::file_not_found, name + ": the file is missing");
    const auto input = OIIO::ImageInput::open(name);
    if (!input) unreadable(name, "not a readable image: " + OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    if (!spec.format.is_floating_point())
      throw Error(ErrorCode::wrong_channel_type,
                  name + ": it holds integers, not radiance; give an OpenEXR or Radiance HDR file");
    FloatImage out{spec.width, spec.height, spec.channelnames, {}};
    out.values.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                      spec.channelnames.size());
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, out.values.data()))
      unreadable(name, "the image is damaged: " + input->geterror());
    return out;
  }

  std::string encode_exr(const FloatImage& image) const override {
    OIIO::Filesystem::IOVecOutput memory;
    const auto output = OIIO::ImageOutput::create("exr");
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()),
                         OIIO::TypeDesc::FLOAT);
    spec.channelnames = image.channels;
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "1970:01:01 00:00:00");  // or else the present: equal images give equal bytes
    const bool written = output && output->set_ioproxy(&memory) && output->open("memory.exr", spec) &&
                         output->write_image(OIIO::TypeDesc::FLOAT, image.values.data()) && output->close();
    if (!written)
      throw Error(ErrorCode::write_failed, "an image cannot be encoded as OpenEXR: " + OIIO::geterror());
    const auto& bytes = memory.buffer();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  std::string encode_png(int width, int height, const std::vector<std::uint8_t>& rgb) const override {
    OIIO::Filesystem::IOVecOutput memory;
    const auto output = OIIO::ImageOutput::create("png");
    const OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    const bool written = output && output->set_ioproxy(&memory) && output->open("memory.png", spec) &&
                         output->write_image(OIIO::TypeDesc::UINT8, rgb.data()) && output->close();
    if (!written)
      throw Error(ErrorCode::write_failed, "a texture cannot be encoded as PNG: " + OIIO::geterror());
    const auto& bytes = memory.buffer();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
};

}  // namespace
}  // namespace vsgl::scene

extern "C" const vsgl::scene::ImageCodec& vsgl_image_codec() {
  static const vsgl::scene::OiioCodec codec;
  return codec;
}
