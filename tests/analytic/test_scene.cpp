#include "test_scene.h"

#include <unistd.h>

#include <fstream>

namespace vsgl::test {

scene::Scene test_scene(const std::string& name, const scene::GenerateOptions& options) {
  std::string pattern = (std::filesystem::temp_directory_path() / "vsgl-scene-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make " + pattern);
  const std::filesystem::path folder = pattern;
  for (const scene::GeneratedFile& file : scene::generate_scene(name, options, folder, "scene").files)
    std::ofstream(folder / file.name, std::ios::binary) << file.bytes;
  scene::Scene scene = scene::load_scene(folder / "scene.json");
  std::filesystem::remove_all(folder);
  return scene;
}

}  // namespace vsgl::test
