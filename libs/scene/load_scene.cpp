#include <algorithm>

#include "scene/mesh_file.h"
#include "scene/scene.h"
#include "scene/scene_sequence.h"
#include "scene/scene_spec.h"

namespace vsgl::scene {

namespace fs = std::filesystem;

std::size_t Scene::triangle_count() const {
  std::size_t count = 0;
  for (const Instance& instance : instances) count += instance.indices.size() / 3;
  return count;
}

Scene load_scene(const fs::path& json_path, int frame) {
  return SceneSequence(json_path).at(frame);
}

std::vector<fs::path> scene_files(const fs::path& json_path) {
  const SceneSpec spec = read_scene_spec(JsonValue::parse_file(json_path), json_path.parent_path());
  std::vector<fs::path> files{json_path};
  const auto add = [&](const fs::path& file) {
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  };
  for (const MeshSpec& mesh : spec.meshes)
    for (const fs::path& file : mesh_file_dependencies(mesh.file)) add(file);
  for (const MaterialOverride& material : spec.materials)
    for (const auto& texture :
         {material.base_color_texture, material.metallic_roughness_texture, material.normal_texture})
      if (texture && texture->file) add(*texture->file);
  if (spec.environment) add(spec.environment->file);
  return files;
}

}  // namespace vsgl::scene
