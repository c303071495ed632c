#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/mesh_file.h"
#include "scene/scene_spec.h"

namespace vsgl::scene {

// A node of a mesh file where the scene puts it.
struct PlacedNode {
  const MeshSpec* mesh;
  const MeshFile* file;
  const MeshNode* node;
  Mat4 transform;  // relative to the anchor
};

// The camera that the scene JSON describes or names, or the first perspective one of the mesh files. Throws
// bad_camera.
Camera choose_camera(const SceneSpec& spec, const std::vector<PlacedNode>& nodes, Vec3 anchor,
                     const std::filesystem::path& json_path, std::vector<std::string>& warnings);

// The lights of the scene JSON, or else those of the mesh files; names are made unique. Throws bad_light.
std::vector<LightSource> collect_lights(const SceneSpec& spec, const std::vector<PlacedNode>& nodes,
                                        Vec3 anchor, double radius, const std::filesystem::path& json_path,
                                        std::vector<std::string>& warnings);

}  // namespace vsgl::scene
