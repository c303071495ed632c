#include "test_scene.h"

#include <fstream>

#include "../unit/expect_error.h"

namespace vsgl::test {

scene::Scene test_scene(const std::string& name, const scene::GenerateOptions& options) {
  const TemporaryFolder folder;
  for (const scene::GeneratedFile& file : scene::generate_scene(name, options, folder / "", "scene").files)
    std::ofstream(folder / file.name, std::ios::binary) << file.bytes;
  return scene::load_scene(folder / "scene.json");
}

}  // namespace vsgl::test
