#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace vsgl::scene {

// An image of floating-point channels, interleaved, row by row from the top-left.
struct FloatImage {
  int width = 0, height = 0;
  std::vector<std::string> channels;  // their names
  std::vector<float> values;
};

// Reads and writes image files, by OpenImageIO. That comes with some 250 shared libraries, which take a
// quarter of a second to load; so it is linked to a library of its own, libs/scene/codec, which is loaded
// when the first image is wanted: most scenes have none.
class ImageCodec {
 public:
  virtual ~ImageCodec() = default;

  // As read_texture() of scene/texture.h.
  virtual Texture read(const std::filesystem::path& path, bool srgb) const = 0;
  virtual Texture read(std::span<const unsigned char> bytes, const std::string& format,
                       const std::string& name, bool srgb) const = 0;
  // OpenEXR (the first part) or Radiance HDR, all channels. Throws file_not_found, texture_unreadable,
  // wrong_channel_type where the file holds integers.
  virtual FloatImage read_float(const std::filesystem::path& path) const = 0;
  // The bytes of an OpenEXR file. Throws write_failed.
  virtual std::string encode_exr(const FloatImage& image) const = 0;
  // The bytes of a PNG of width * height pixels, RGB. Throws write_failed.
  virtual std::string encode_png(int width, int height, const std::vector<std::uint8_t>& rgb) const = 0;
};

// Throws texture_unreadable where the library is not where it is installed, lib/vsgltools beside bin.
const ImageCodec& image_codec();

}  // namespace vsgl::scene
