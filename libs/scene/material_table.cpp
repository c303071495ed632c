#include "scene/material_table.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/strict_json.h"
#include "interop/model.h"

namespace vsgl::scene {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] void unknown(const std::string& where, const std::string& name,
                          const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  throw Error(ErrorCode::json_unknown_key,
              where + ": no material is called \"" + name + "\"" +
                  (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

// The model's bounds, for what mesh files say; the JSON's own values are checked as they are read.
void check(const std::string& where, const Material& material) {
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorCode::bad_material, where + ": material \"" + material.name + "\": " + what +
                                             "; set it under \"materials\" in the scene JSON");
  };
  for (const Vec3 colour : {material.base_color, material.specular})
    for (const double value : to_array(colour))
      if (!(value >= 0 && value <= 1))
        fail("a reflectance of " + std::to_string(value) + " is outside 0 to 1");
  if (!(material.metallic >= 0 && material.metallic <= 1)) fail("metallic must be from 0 to 1");
  const bool has_lobe = material.metallic > 0 || material.specular != Vec3{};
  const bool phong = material.ndf == interop::NDF_PHONG;
  const double minimum =
      phong ? std::sqrt(2 / 65537.0) * (1 - 1e-6) : min_alpha;  // the exponent 65535, rounded
  if (has_lobe && !(material.alpha >= minimum && material.alpha <= 1)) {
    fail("its lobe's alpha of " + std::to_string(material.alpha) + " must be from " +
         (phong ? "0.005524 (Phong exponent 65535)" : "0.001") + " to 1");
  }
}

}  // namespace

MaterialTable::MaterialTable(const SceneSpec& spec, const MeshFiles& files, TexturePool& textures)
    : spec_(spec), files_(files), textures_(textures) {
  check_names();
}

void MaterialTable::check_names() const {
  std::vector<std::string> loaded, overridden, assigned_names;
  for (const auto& [path, file] : files_)
    for (const Material& material : file.materials) loaded.push_back(material.name);
  for (const MaterialOverride& material : spec_.materials) overridden.push_back(material.name);
  std::vector<std::string> known = overridden;
  known.insert(known.end(), loaded.begin(), loaded.end());
  for (const MeshSpec& mesh : spec_.meshes) {
    if (!mesh.material) continue;
    if (*mesh.material == "*" || !contains(known, *mesh.material))
      unknown(mesh.where + "/material", *mesh.material, known);
    assigned_names.push_back(*mesh.material);
  }
  for (const MaterialOverride& material : spec_.materials) {
    const bool used =
        material.name == "*" || contains(loaded, material.name) || contains(assigned_names, material.name);
    if (!used) unknown(material.where, material.name, loaded);
  }
}

int MaterialTable::index(const MeshSpec& mesh, int material) {
  if (mesh.material) return index(mesh.where, '\n' + *mesh.material, assigned(*mesh.material));
  const std::string file = mesh.file.string();
  return index(file, file + '\n' + std::to_string(material), files_.at(mesh.file).materials[material]);
}

// A material of some mesh file, or a new one that only the JSON describes.
Material MaterialTable::assigned(const std::string& name) const {
  for (const auto& [path, file] : files_)
    for (const Material& material : file.materials)
      if (material.name == name) return material;
  Material out;
  out.name = name;
  out.specular = {};
  return out;
}

int MaterialTable::index(const std::string& where, const std::string& key, const Material& original) {
  const auto [entry, fresh] = index_of_.try_emplace(key, static_cast<int>(materials_.size()));
  if (!fresh) return entry->second;
  Material material = original;
  for (const MaterialOverride& from : spec_.materials) {  // "*" comes first
    if (from.name == "*" || from.name == material.name) apply(from, material);
  }
  check(where, material);
  materials_.push_back(std::move(material));
  return entry->second;
}

// Stating a reflectance makes the surface a dielectric unless the override says otherwise.
void MaterialTable::apply(const MaterialOverride& from, Material& to) {
  if (from.diffuse || from.specular) to.metallic = 0;
  if (from.diffuse) to.base_color = *from.diffuse;
  if (from.specular) to.specular = *from.specular;
  if (from.metallic) to.metallic = *from.metallic;
  if (from.alpha) to.alpha = *from.alpha;
  if (from.ndf) to.ndf = *from.ndf;
  if (from.normal_scale) to.normal_scale = *from.normal_scale;
  if (from.alpha_cutoff) to.alpha_cutoff = *from.alpha_cutoff;
  if (from.base_color_texture) to.base_color_texture = texture_index(*from.base_color_texture, true);
  if (from.metallic_roughness_texture) {
    to.metallic_roughness_texture = texture_index(*from.metallic_roughness_texture, false);
  }
  if (from.normal_texture) to.normal_texture = texture_index(*from.normal_texture, false);
}

int MaterialTable::texture_index(const TextureOverride& texture, bool srgb) {
  return texture.file ? textures_.add(*texture.file, srgb) : -1;
}

std::vector<std::string> MaterialTable::warnings() const {
  std::vector<std::string> out;
  for (const Material& material : materials_) {
    if (material.base_color_texture >= 0) continue;  // the factor alone says little
    const Vec3 total = material.base_color + material.specular * (1 - material.metallic);
    const double most = std::max({total.x, total.y, total.z});
    if (most <= 1 + 1e-6) continue;
    out.push_back("material \"" + material.name + "\": diffuse + specular reflectance is " +
                  std::to_string(most) + ": it reflects more light than it receives");
  }
  return out;
}

}  // namespace vsgl::scene
