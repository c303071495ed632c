#include <algorithm>
#include <sstream>

#include "base/atomic_file.h"
#include "scene/mesh_file.h"

namespace vsgl::scene {
namespace {

namespace fs = std::filesystem;

// The rest of every line that starts with one of the keywords, without options ("-bm 0.5") where there are
// any.
std::vector<std::string> arguments_of(const std::string& text, const std::vector<std::string>& keywords) {
  std::vector<std::string> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword, rest;
    words >> keyword >> std::ws;
    if (std::find(keywords.begin(), keywords.end(), keyword) == keywords.end()) continue;
    std::getline(words, rest);
    while (!rest.empty() && (rest.back() == '\r' || rest.back() == ' ')) rest.pop_back();
    if (rest.starts_with('-')) rest = rest.substr(rest.find_last_of(' ') + 1);
    std::replace(rest.begin(), rest.end(), '\\', '/');
    if (!rest.empty()) out.push_back(rest);
  }
  return out;
}

void add_existing(const fs::path& file, std::vector<fs::path>& files) {
  if (fs::is_regular_file(file) && std::find(files.begin(), files.end(), file) == files.end())
    files.push_back(file);
}

}  // namespace

std::vector<fs::path> material_libraries(const fs::path& obj) {
  std::vector<fs::path> out;
  for (const std::string& name : arguments_of(read_text(obj), {"mtllib"}))
    out.push_back(obj.parent_path() / name);
  return out;
}

std::vector<fs::path> mesh_file_dependencies(const fs::path& path) {
  const MeshFormat format = mesh_format(path);
  std::vector<fs::path> files{path};
  if (format == MeshFormat::gltf) {
    for (const fs::path& file : read_gltf(path).files) files.push_back(file);
  } else if (format == MeshFormat::obj) {
    for (const fs::path& library : material_libraries(path)) {
      if (!fs::is_regular_file(library)) continue;
      add_existing(library, files);
      for (const std::string& image : arguments_of(read_text(library), {"map_Kd", "map_kd", "norm"})) {
        add_existing(path.parent_path() / image, files);
      }
    }
  }
  return files;
}

}  // namespace vsgl::scene
