#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scene/mesh_file.h"
#include "scene/scene_spec.h"
#include "scene/scene_views.h"

namespace vsgl::scene {

using MeshFiles = std::map<std::filesystem::path, MeshFile>;

// All nodes of all meshes, in order. `spec` and `files` must outlive them.
std::vector<PlacedNode> place_nodes(const SceneSpec& spec, const MeshFiles& files, Vec3 anchor);

// A mesh of the node in world orientation, without triangles that have no area, and with the winding that a
// mirroring transform asks for. Throws mesh_invalid.
Instance make_instance(const PlacedNode& placed, const Mesh& mesh, int material);

// "room.glb: node "floor"", for messages.
std::string where(const PlacedNode& placed);

// Vertices as doubles.
inline Vec3 position_of(const Vertex& vertex) {
  const auto& p = vertex.position;
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace vsgl::scene
