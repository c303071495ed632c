#include "stages/rsm/device_scene.h"

#include <span>

#include "base/error.h"
#include "base/hash.h"
#include "gpu/address.h"
#include "math/interop_vec.h"
#include "stages/rsm/mip_chain.h"

namespace vsgl {
namespace {

static_assert(sizeof(scene::Vertex) == sizeof(interop::Vertex), "vertices are copied as they are");

void require_index(const scene::Instance& instance, std::size_t index, std::size_t count, const char* what) {
  if (index < count) return;
  throw Error(ErrorCode::mesh_invalid, "instance \"" + instance.name + "\": " + what + " " +
                                           std::to_string(index) + " of " + std::to_string(count) +
                                           " does not exist");
}

std::vector<interop::Vertex> all_vertices(const scene::Scene& scene) {
  std::vector<interop::Vertex> vertices;
  for (const scene::Instance& instance : scene.instances) {
    for (const scene::Vertex& v : instance.vertices) {
      vertices.push_back({{v.position[0], v.position[1], v.position[2]},
                          {v.normal[0], v.normal[1], v.normal[2]},
                          {v.tangent[0], v.tangent[1], v.tangent[2], v.tangent[3]},
                          {v.uv[0], v.uv[1]}});
    }
  }
  return vertices;
}

std::vector<interop::Triangle> all_triangles(const scene::Scene& scene) {
  std::vector<interop::Triangle> triangles;
  interop::uint first = 0, id = 0;
  for (const scene::Instance& instance : scene.instances) {
    for (const std::uint32_t index : instance.indices)
      require_index(instance, index, instance.vertices.size(), "vertex");
    for (std::size_t i = 0; i + 2 < instance.indices.size(); i += 3) {
      const std::uint32_t* corner = &instance.indices[i];
      triangles.push_back({first + corner[0], first + corner[1], first + corner[2], id});
    }
    first += static_cast<interop::uint>(instance.vertices.size());
    ++id;
  }
  return triangles;
}

std::vector<interop::uint> instance_materials(const scene::Scene& scene) {
  std::vector<interop::uint> materials;
  for (const scene::Instance& instance : scene.instances) {
    require_index(instance, static_cast<std::size_t>(instance.material), scene.materials.size(), "material");
    materials.push_back(static_cast<interop::uint>(instance.material));
  }
  return materials;
}

int texture_index(const scene::Scene& scene, const scene::Material& material, int index) {
  if (index < static_cast<int>(scene.textures.size())) return index;
  throw Error(ErrorCode::mesh_invalid,
              "material \"" + material.name + "\": texture " + std::to_string(index) + " does not exist");
}

std::vector<interop::Material> all_materials(const scene::Scene& scene) {
  std::vector<interop::Material> materials;
  for (const scene::Material& m : scene.materials) {
    materials.push_back({to_float(m.base_color), static_cast<float>(m.metallic), to_float(m.specular),
                         static_cast<float>(m.alpha), m.ndf, static_cast<float>(m.alpha_cutoff),
                         static_cast<float>(m.normal_scale), texture_index(scene, m, m.base_color_texture),
                         texture_index(scene, m, m.metallic_roughness_texture),
                         texture_index(scene, m, m.normal_texture)});
  }
  return materials;
}

// Of all that the mip chain is made from.
std::string digest(const scene::Texture& texture) {
  return sha256(std::as_bytes(std::span(texture.rgba))) + " " + std::to_string(texture.width) + "x" +
         std::to_string(texture.height) + (texture.srgb ? " sRGB" : " linear");
}

}  // namespace

template <class T>
void DeviceScene::upload(Part& part, const std::vector<T>& values) {
  const std::string digest = sha256(std::as_bytes(std::span(values)));
  if (part.digest == digest) return;
  part = {digest, gpu::Buffer::from(device_, values)};
}

void DeviceScene::upload_texels(const scene::Scene& scene) {
  texels_.resize(scene.textures.size());
  std::vector<interop::Texture> textures;
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const scene::Texture& t = scene.textures[i];
    const std::string wanted = digest(t);
    if (texels_[i].digest != wanted) texels_[i] = {wanted, gpu::Buffer::from(device_, build_mip_chain(t))};
    textures.push_back({address_of(*texels_[i].buffer), static_cast<interop::uint>(t.width),
                        static_cast<interop::uint>(t.height),
                        static_cast<interop::uint>(mip_levels(t.width, t.height)), t.srgb ? 1u : 0u});
  }
  upload(textures_, textures);
}

void DeviceScene::update(const scene::Scene& scene) {
  triangle_count_ = static_cast<std::uint32_t>(scene.triangle_count());
  upload(vertices_, all_vertices(scene));
  upload(triangles_, all_triangles(scene));
  upload(instance_materials_, instance_materials(scene));
  upload(materials_, all_materials(scene));
  upload_texels(scene);
}

interop::Geometry DeviceScene::geometry() const {
  return {address_of(*vertices_.buffer), address_of(*triangles_.buffer),
          address_of(*instance_materials_.buffer), address_of(*materials_.buffer),
          address_of(*textures_.buffer)};
}

}  // namespace vsgl
