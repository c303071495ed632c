#pragma once

#include <cstdint>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "interop/geometry.h"
#include "scene/scene.h"

namespace vsgl {

// Vertices, triangles, materials and textures of a scene on the device.
class DeviceScene {
 public:
  // Throws mesh_invalid when an index points nowhere, texture_unreadable for a texture of the wrong size.
  DeviceScene(const scene::Scene& scene, gpu::Device& device);

  interop::Geometry geometry() const;
  std::uint32_t triangle_count() const { return triangle_count_; }

 private:
  std::uint32_t triangle_count_ = 0;
  gpu::Buffer vertices_, triangles_, instance_materials_, materials_;
  std::vector<gpu::Buffer> texels_;  // a buffer per texture
  gpu::Buffer textures_;
};

}  // namespace vsgl
