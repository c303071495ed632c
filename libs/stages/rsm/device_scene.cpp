#include "stages/rsm/device_scene.h"

#include <string>

#include "base/error.h"
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

std::vector<gpu::Buffer> upload_texels(const scene::Scene& scene, gpu::Device& device) {
  std::vector<gpu::Buffer> buffers;
  for (const scene::Texture& texture : scene.textures) {
    buffers.push_back(gpu::Buffer::from(device, build_mip_chain(texture)));
  }
  return buffers;
}

std::vector<interop::Texture> all_textures(const scene::Scene& scene,
                                           const std::vector<gpu::Buffer>& texels) {
  std::vector<interop::Texture> textures;
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const scene::Texture& t = scene.textures[i];
    textures.push_back({address_of(texels[i]), static_cast<interop::uint>(t.width),
                        static_cast<interop::uint>(t.height),
                        static_cast<interop::uint>(mip_levels(t.width, t.height)), t.srgb ? 1u : 0u});
  }
  return textures;
}

}  // namespace

DeviceScene::DeviceScene(const scene::Scene& scene, gpu::Device& device)
    : triangle_count_(static_cast<std::uint32_t>(scene.triangle_count())),
      vertices_(gpu::Buffer::from(device, all_vertices(scene))),
      triangles_(gpu::Buffer::from(device, all_triangles(scene))),
      instance_materials_(gpu::Buffer::from(device, instance_materials(scene))),
      materials_(gpu::Buffer::from(device, all_materials(scene))),
      texels_(upload_texels(scene, device)),
      textures_(gpu::Buffer::from(device, all_textures(scene, texels_))) {}

interop::Geometry DeviceScene::geometry() const {
  return {address_of(vertices_), address_of(triangles_), address_of(instance_materials_),
          address_of(materials_), address_of(textures_)};
}

}  // namespace vsgl
