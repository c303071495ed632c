#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/gltf.h"
#include "scene/scene.h"
#include "scene/texture.h"

namespace vsgl::scene {

enum class MeshFormat { gltf, obj, ply };

// By the file name's extension. Throws mesh_unreadable for any other.
MeshFormat mesh_format(const std::filesystem::path& path);

// Triangles in their own coordinates.
struct Mesh {
  std::string name;
  int material = 0;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

struct MeshNode {
  std::string name;
  int parent = -1;  // comes earlier in the list
  Mat4 local;
  std::vector<int> meshes;
  int camera = -1, light = -1;  // index into MeshFile
};

struct MeshFile {
  std::vector<Mesh> meshes;
  std::vector<MeshNode> nodes;
  std::vector<Material> materials;
  std::vector<GltfCamera> cameras;
  std::vector<GltfLight> lights;
  std::vector<std::string> warnings;
};

// Reads glTF 2.0, OBJ or PLY. Absent normals are made: flat in glTF, as its specification asks; smooth across
// edges of less than 60 degrees in OBJ and PLY. Tangents are exact where a material has a normal map or
// `all_tangents` is set, some perpendicular otherwise. Textures go to `textures`. Throws file_not_found,
// mesh_unreadable, mesh_invalid, texture_unreadable.
MeshFile load_mesh_file(const std::filesystem::path& path, bool all_tangents, TexturePool& textures);

// The files that load_mesh_file() reads: the file itself, buffers, material libraries, textures.
std::vector<std::filesystem::path> mesh_file_dependencies(const std::filesystem::path& path);

// The .mtl files that an OBJ file names, whether they exist or not.
std::vector<std::filesystem::path> material_libraries(const std::filesystem::path& obj);

}  // namespace vsgl::scene
