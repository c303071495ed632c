#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "interop/geometry.h"
#include "scene/scene.h"

namespace vsgl {

// Vertices, triangles, materials and textures of a scene on the device.
class DeviceScene {
 public:
  DeviceScene(const scene::Scene& scene, gpu::Device& device) : device_(device) { update(scene); }

  // Uploads what differs from what is there. Throws mesh_invalid when an index points nowhere,
  // texture_unreadable for a texture of the wrong size; what is there may then be of both scenes.
  void update(const scene::Scene& scene);

  interop::Geometry geometry() const;
  std::uint32_t triangle_count() const { return triangle_count_; }

 private:
  // A buffer, told from others by the SHA-256 of what it was made from.
  struct Part {
    std::string digest;
    std::optional<gpu::Buffer> buffer;
  };
  template <class T>
  void upload(Part& part, const std::vector<T>& values);
  void upload_texels(const scene::Scene& scene);

  gpu::Device& device_;
  std::uint32_t triangle_count_ = 0;
  Part vertices_, triangles_, instance_materials_, materials_, textures_;
  std::vector<Part> texels_;  // one per texture
};

}  // namespace vsgl
