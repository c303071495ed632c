#include "scene/texture.h"

#include <cmath>

#include "base/error.h"
#include "scene/image_codec.h"

namespace vsgl::scene {
Texture read_texture(const std::filesystem::path& path, bool srgb) {
  return image_codec().read(path, srgb);
}

Texture read_texture(std::span<const unsigned char> bytes, const std::string& format, const std::string& name,
                     bool srgb) {
  return image_codec().read(bytes, format, name, srgb);
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
