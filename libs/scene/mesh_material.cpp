#include "scene/mesh_material.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "interop/model.h"
#include "scene/gltf_file.h"

namespace vsgl::scene {
namespace {

namespace fs = std::filesystem;

double number_of(const aiMaterial& material, const char* key, unsigned type, unsigned index,
                 double fallback) {
  ai_real value;
  return material.Get(key, type, index, value) == aiReturn_SUCCESS ? static_cast<double>(value) : fallback;
}

Vec3 colour_of(const aiMaterial& material, const char* key, unsigned type, unsigned index, Vec3 fallback) {
  aiColor4D value;
  if (material.Get(key, type, index, value) != aiReturn_SUCCESS) return fallback;
  return {static_cast<double>(value.r), static_cast<double>(value.g), static_cast<double>(value.b)};
}

// An image as a mesh file names it: literally, with escapes, or with the backslashes of another system.
fs::path find_image(const fs::path& folder, std::string name) {
  if (fs::exists(folder / name)) return folder / name;
  name = decode_percent(name);
  if (!fs::exists(folder / name)) std::replace(name.begin(), name.end(), '\\', '/');
  return folder / name;
}

int import_texture(const aiScene& scene, const aiMaterial& material, aiTextureType type, bool srgb,
                   const fs::path& folder, TexturePool& textures, std::vector<std::string>& warnings) {
  aiString path;
  unsigned uv_set = 0;
  if (material.GetTexture(type, 0, &path, nullptr, &uv_set) != aiReturn_SUCCESS || path.length == 0)
    return -1;
  if (uv_set != 0) {
    warnings.push_back((folder / path.C_Str()).string() +
                       ": texture coordinates of set 0 are used instead of set " + std::to_string(uv_set));
  }
  if (const aiTexture* embedded = scene.GetEmbeddedTexture(path.C_Str())) {
    const std::string name = valid_text((folder / path.C_Str()).string());
    if (embedded->mHeight != 0)
      throw Error(ErrorCode::texture_unreadable, name + ": raw embedded texels are not supported");
    const std::span bytes(reinterpret_cast<const unsigned char*>(embedded->pcData), embedded->mWidth);
    return textures.add(name, srgb, [&] { return read_texture(bytes, embedded->achFormatHint, name, srgb); });
  }
  return textures.add(find_image(folder, path.C_Str()), srgb);
}

// Blended materials count as cut-outs at one half. Without a texture the whole surface is either there or
// not.
void import_alpha(const aiMaterial& material, Material& out, std::vector<std::string>& warnings) {
  aiString mode;
  material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode);
  const bool blend = std::string(mode.C_Str()) == "BLEND";
  if (!blend && std::string(mode.C_Str()) != "MASK") return;
  if (blend) warnings.push_back("material \"" + out.name + "\": blending is taken as a cut-out at alpha 0.5");
  aiColor4D base(1, 1, 1, 1);
  material.Get(AI_MATKEY_BASE_COLOR, base);
  const double cutoff = blend ? 0.5 : number_of(material, AI_MATKEY_GLTF_ALPHACUTOFF, 0.5);
  const double alpha = static_cast<double>(base.a);
  out.alpha_cutoff = alpha >= cutoff ? cutoff / std::max(alpha, 1e-9) : invisible_cutoff;
}

// glTF's metallic-roughness model; its normal textures have green up, as Assimp's texture space has v up.
void import_gltf(const aiMaterial& material, Material& out, std::vector<std::string>& warnings) {
  out.base_color = colour_of(material, AI_MATKEY_BASE_COLOR, {1, 1, 1});
  out.metallic = number_of(material, AI_MATKEY_METALLIC_FACTOR, 1);
  const double roughness = number_of(material, AI_MATKEY_ROUGHNESS_FACTOR, 1);
  out.alpha = roughness * roughness;
  out.normal_scale = number_of(material, AI_MATKEY_GLTF_TEXTURE_SCALE(aiTextureType_NORMALS, 0), 1);
  import_alpha(material, out, warnings);
}

// MTL's Ns is a Phong exponent; without Ks there is no specular lobe.
void import_mtl(const aiMaterial& material, Material& out, std::vector<std::string>& warnings) {
  out.base_color = colour_of(material, AI_MATKEY_COLOR_DIFFUSE, out.base_color);
  out.specular = colour_of(material, AI_MATKEY_COLOR_SPECULAR, {});
  out.ndf = interop::NDF_PHONG;
  out.alpha = std::sqrt(2 / (number_of(material, AI_MATKEY_SHININESS, 0) + 2));
  if (number_of(material, AI_MATKEY_OPACITY, 1) < 1) {
    warnings.push_back("material \"" + out.name + "\": transparency is ignored");
  }
  if (material.GetTextureCount(aiTextureType_HEIGHT) > 0) {
    warnings.push_back("material \"" + out.name + "\": the bump map is ignored; a normal map (norm) is not");
  }
}

}  // namespace

std::string valid_text(const std::string& name) {
  using nlohmann::json;
  return json::parse(json(name).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

Material import_material(const aiScene& scene, const aiMaterial& material, MeshFormat format,
                         const fs::path& folder, TexturePool& textures, std::vector<std::string>& warnings) {
  Material out;
  out.name = valid_text(material.GetName().C_Str());
  const auto texture = [&](aiTextureType type, bool srgb) {
    return import_texture(scene, material, type, srgb, folder, textures, warnings);
  };
  if (format == MeshFormat::gltf) {
    import_gltf(material, out, warnings);
    out.base_color_texture = texture(aiTextureType_BASE_COLOR, true);
    out.metallic_roughness_texture = texture(aiTextureType_UNKNOWN, false);
  } else if (format == MeshFormat::obj) {
    import_mtl(material, out, warnings);
    out.base_color_texture = texture(aiTextureType_DIFFUSE, true);
  } else {
    out.specular = {};  // PLY has no materials
  }
  if (format != MeshFormat::ply) out.normal_texture = texture(aiTextureType_NORMALS, false);
  return out;
}

}  // namespace vsgl::scene
