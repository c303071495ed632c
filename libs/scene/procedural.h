#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "math/vec.h"

namespace vsgl::scene {

// What shapes a generated scene. A scene reads what concerns it.
struct GenerateOptions {
  Vec3 offset;  // moves everything, m
  double scale =
      1;  // scales everything about the origin, before the offset; light intensity grows with scale^2
  std::optional<int> width, height;
  std::uint64_t seed = 0;
  std::optional<double> alpha;     // of glossy surfaces
  std::optional<double> exponent;  // Phong, instead of alpha
  std::string ndf = "ggx";
  int triangles = 20000;              // atrium: at most this many
  std::filesystem::path texture_dir;  // atrium: of glmark2's textures; empty: made
  std::filesystem::path mesh;         // cornell: stands in the box instead of the blocks
  std::string mesh_material = "diffuse";
  std::string animate = "none";  // or light, camera, object: what moves
  std::optional<int> frames;     // of the animation, 2..10000
};

struct GeneratorInfo {
  std::string name, summary;
};
// All scenes that can be made.
const std::vector<GeneratorInfo>& generators();

struct GeneratedFile {
  std::string name;  // without folder
  std::string bytes;
};
struct GeneratedScene {
  std::vector<GeneratedFile> files;  // <stem>.json first, then <stem>.glb and textures
  std::size_t triangles = 0;         // without --mesh
};

// Makes a scene to be written into `folder` under `stem`. Equal options give equal bytes. Throws bad_value
// for an unknown name, out_of_range, conflicting_options, and what load_scene() throws for the mesh.
GeneratedScene generate_scene(const std::string& name, const GenerateOptions& options,
                              const std::filesystem::path& folder, const std::string& stem);

// The files that the scene takes from elsewhere, of those that `options` name: the mesh, the textures.
std::vector<std::filesystem::path> referenced_files(const GenerateOptions& options);

}  // namespace vsgl::scene
