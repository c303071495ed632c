#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace vsgl::scene {

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
  // The bytes of a PNG of width * height pixels, RGB. Throws write_failed.
  virtual std::string encode_png(int width, int height, const std::vector<std::uint8_t>& rgb) const = 0;
};

// Throws texture_unreadable where the library is not where it is installed, lib/vsgltools beside bin.
const ImageCodec& image_codec();

}  // namespace vsgl::scene
