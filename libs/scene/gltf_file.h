#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/strict_json.h"

namespace vsgl::scene {

// A glTF 2.0 file with its binary buffers, all of them present and every accessor inside them.
struct GltfFile {
  JsonValue json;
  std::vector<std::string> buffers;                 // bytes
  std::vector<std::filesystem::path> buffer_files;  // external ones
};

// Reads .gltf or .glb and checks what Assimp 5.2 lets through or drops silently: lengths of buffers, views
// and accessors, vertex counts, vertex indices, the node tree, required extensions. Throws file_not_found,
// json_* and mesh_unreadable.
GltfFile read_gltf_file(const std::filesystem::path& path);

// "my%20texture.png" -> "my texture.png"
std::string decode_percent(const std::string& uri);

}  // namespace vsgl::scene
