#pragma once

#include <filesystem>

namespace vsgl::scene {

// Checks that a PLY file is what its header says: known types, as much data, vertex indices in range.
// Assimp 5.2 crashes or runs forever on some files that are not. Throws file_not_found and mesh_unreadable.
void check_ply_file(const std::filesystem::path& path);

}  // namespace vsgl::scene
