#pragma once

#include <assimp/scene.h>

#include <filesystem>

#include "scene/mesh_file.h"
#include "scene/scene.h"
#include "scene/texture.h"

namespace vsgl::scene {

// Material::alpha_cutoff of a surface that its constant alpha makes invisible: nothing of it is rendered.
inline constexpr double invisible_cutoff = 2;

// A name from a mesh file as valid UTF-8, for messages and JSON: broken bytes become U+FFFD.
std::string valid_text(const std::string& name);

// Assimp's material as ours: metallic-roughness from glTF; Kd, Ks and the Phong exponent Ns from MTL.
Material import_material(const aiScene& scene, const aiMaterial& material, MeshFormat format,
                         const std::filesystem::path& folder, TexturePool& textures,
                         std::vector<std::string>& warnings);

}  // namespace vsgl::scene
