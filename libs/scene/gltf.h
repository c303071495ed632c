#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "math/light_source.h"
#include "math/vec.h"

namespace vsgl::scene {

struct GltfNode {
  std::string name;
  Mat4 local;
  std::vector<int> children;
  int camera = -1, light = -1;
};

struct GltfCamera {
  std::string name;
  bool perspective = true;
  double vertical_fov = 0;  // radians
};

// KHR_lights_punctual.
struct GltfLight {
  std::string name;
  LightType type = LightType::point;
  Vec3 intensity;                         // candela; directional: lux
  double inner_cone = 0, outer_cone = 0;  // half angles, radians
};

// What Assimp 5.2 reads in single precision or loses: the node tree in double, cameras, and lights that
// several nodes share. Indices of nodes, materials and textures are the file's own.
struct GltfDocument {
  std::vector<GltfNode> nodes;
  std::vector<int> roots;  // of the default scene
  std::vector<GltfCamera> cameras;
  std::vector<GltfLight> lights;
  // By material name: KHR_materials_specular's reflectance at normal incidence. Assimp 5.2 hands over
  // materials in another order.
  std::map<std::string, Vec3> specular;
  std::vector<std::filesystem::path> files;  // external buffers, and images that materials use
  std::vector<std::string> warnings;
};

// Throws file_not_found, and mesh_unreadable for whatever is wrong in the file.
GltfDocument read_gltf(const std::filesystem::path& path);

}  // namespace vsgl::scene
