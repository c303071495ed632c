#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "scene/scene.h"

namespace vsgl::scene {

// Reads an image file as 8-bit RGBA; grey becomes R = G = B, a missing alpha 255. Throws texture_unreadable.
Texture read_texture(const std::filesystem::path& path, bool srgb);
// The same from the bytes of an image file; `format` is its extension ("png"), `name` stands in messages.
Texture read_texture(std::span<const unsigned char> bytes, const std::string& format, const std::string& name,
                     bool srgb);

// Makes the vectors of a normal map's texels unit, as they are meant to be: filtering takes a shorter mean
// for normals that spread. Those that are unit but for rounding keep their bytes. Zero vectors become (0, 0,
// 1). Returns the share of texels that changed, 0..1.
double normalise_normal_map(Texture& texture);

// Textures by identity, each read once per colour space.
class TexturePool {
 public:
  // The index of the texture read from a file.
  int add(const std::filesystem::path& path, bool srgb);
  // The index of the texture called `name`, which `read` makes when it is not there yet.
  template <typename Read>
  int add(const std::string& name, bool srgb, Read read) {
    for (std::size_t i = 0; i < textures_.size(); ++i)
      if (textures_[i].name == name && textures_[i].srgb == srgb) return static_cast<int>(i);
    textures_.push_back(read());
    return static_cast<int>(textures_.size()) - 1;
  }
  std::vector<Texture> take() { return std::move(textures_); }

 private:
  std::vector<Texture> textures_;
};

}  // namespace vsgl::scene
