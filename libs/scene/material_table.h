#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/instances.h"
#include "scene/scene_spec.h"

namespace vsgl::scene {

// The materials of a scene: those of its mesh files that are in use, with the overrides of the scene JSON.
class MaterialTable {
 public:
  // All of it must outlive the table. Throws json_unknown_key for an override or assignment that names no
  // material.
  MaterialTable(const SceneSpec& spec, const MeshFiles& files, TexturePool& textures);

  // The scene's index of the mesh file's material, or of the one that the JSON assigns to the mesh. Throws
  // bad_material.
  int index(const MeshSpec& mesh, int material);

  const std::vector<Material>& all() const { return materials_; }
  // Materials that reflect more light than they receive.
  std::vector<std::string> warnings() const;

 private:
  void check_names() const;
  Material assigned(const std::string& name) const;
  int index(const std::string& where, const std::string& key, const Material& original);
  void apply(const MaterialOverride& from, Material& to);
  int texture_index(const TextureOverride& texture, bool srgb);

  const SceneSpec& spec_;
  const MeshFiles& files_;
  TexturePool& textures_;
  std::map<std::string, int> index_of_;  // by mesh file and its index, or by the name of an assigned one
  std::vector<Material> materials_;
};

}  // namespace vsgl::scene
