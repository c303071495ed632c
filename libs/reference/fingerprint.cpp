#include "reference/fingerprint.h"

#include <array>
#include <initializer_list>
#include <span>

#include "base/hash.h"

namespace vsgl::reference {
namespace {

// Hashes of blocks, one after another.
class Digest {
 public:
  template <typename T>
  void add(std::span<const T> items) {
    text_ += sha256(std::as_bytes(items));
  }
  template <typename T>
  void add(const std::vector<T>& items) {
    add(std::span<const T>(items));
  }
  void numbers(std::initializer_list<double> values) {
    add(std::span<const double>(values.begin(), values.size()));
  }
  void vectors(std::initializer_list<Vec3> values) {
    add(std::span<const Vec3>(values.begin(), values.size()));
  }

  std::string hash() const { return sha256(std::as_bytes(std::span(text_))); }

 private:
  std::string text_;
};

void add(Digest& digest, const scene::Material& m) {
  digest.vectors({m.base_color, m.specular});
  digest.numbers({m.metallic, m.alpha, double(m.ndf), m.alpha_cutoff, m.normal_scale,
                  double(m.base_color_texture), double(m.metallic_roughness_texture),
                  double(m.normal_texture)});
}

void add(Digest& digest, const LightSource& light) {
  digest.vectors({light.position, light.right, light.up, light.forward, light.intensity});
  digest.numbers({static_cast<double>(light.type), light.cos_inner, light.cos_outer});
}

}  // namespace

std::string fingerprint(const scene::Scene& scene, const GBuffer& gbuffer) {
  Digest digest;
  digest.vectors({scene.anchor, gbuffer.camera});
  digest.numbers({scene.radius, double(gbuffer.width), double(gbuffer.height)});
  for (const scene::Instance& instance : scene.instances) {
    digest.numbers({double(instance.material)});
    digest.add(instance.vertices);
    digest.add(instance.indices);
  }
  for (const scene::Material& material : scene.materials) add(digest, material);
  for (const scene::Texture& texture : scene.textures) {
    digest.numbers({double(texture.width), double(texture.height), double(texture.srgb)});
    digest.add(texture.rgba);
  }
  for (const LightSource& light : scene.lights) add(digest, light);
  digest.add(gbuffer.pixels);
  return digest.hash();
}

}  // namespace vsgl::reference
