#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "math/frame.h"
#include "scene/material_table.h"
#include "scene/mesh_material.h"
#include "scene/scene.h"
#include "scene/scene_views.h"
#include "scene/transform.h"

namespace vsgl::scene {
namespace {

namespace fs = std::filesystem;

struct Bounds {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  bool empty() const { return low.x > high.x; }
};

// The centre of the box rounded to a grid of about 1/16 of its half diagonal, a power of two: moving the
// scene by a multiple of the grid moves the anchor by exactly as much, so that positions relative to it keep
// every bit. The two odd constants keep decimal sizes off the points where rounding changes its mind.
Vec3 choose_anchor(const Bounds& bounds) {
  const double half_diagonal = length(bounds.high - bounds.low) / 2;
  const double grid = std::exp2(std::floor(std::log2(std::max(half_diagonal, 1e-30) * 1.1371)) - 4);
  const auto snap = [grid](double low, double high) {
    return grid * std::floor((low + high) / 2 / grid + 0.5 + 0.1237);
  };
  return {snap(bounds.low.x, bounds.high.x), snap(bounds.low.y, bounds.high.y),
          snap(bounds.low.z, bounds.high.z)};
}

std::array<float, 3> single(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Vec3 wide(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// All nodes of all meshes, in order. Transforms are composed from the outside in: with the anchor subtracted
// first, large offsets cancel before they can swallow digits of anything below them.
std::vector<PlacedNode> place_nodes(const SceneSpec& spec, const MeshFiles& files, Vec3 anchor) {
  std::vector<PlacedNode> out;
  for (const MeshSpec& mesh : spec.meshes) {
    Mat4 outer = translation(-anchor);
    for (const Mat4& step : mesh.transforms) outer = outer * step;
    const MeshFile& file = files.at(mesh.file);
    const std::size_t first = out.size();
    for (const MeshNode& node : file.nodes) {
      const Mat4& parent = node.parent < 0 ? outer : out[first + node.parent].transform;
      out.push_back({&mesh, &file, &node, parent * node.local});
    }
  }
  return out;
}

Bounds bounds_of(const std::vector<PlacedNode>& nodes) {
  Bounds bounds;
  for (const PlacedNode& placed : nodes)
    for (const int mesh : placed.node->meshes)
      for (const Vertex& vertex : placed.file->meshes[mesh].vertices)
        bounds.add(placed.transform.point(wide(vertex.position)));
  return bounds;
}

std::vector<Vertex> transform_vertices(const std::vector<Vertex>& vertices, const Mat4& transform,
                                       const std::string& where) {
  const float handedness = determinant(transform) < 0 ? -1.0f : 1.0f;
  std::vector<Vertex> out;
  out.reserve(vertices.size());
  for (const Vertex& vertex : vertices) {
    const Vec3 position = transform.point(wide(vertex.position));
    const Vec3 normal = normalise(transform_normal(transform, wide(vertex.normal)));
    const Vec3 along = transform.direction(wide({vertex.tangent[0], vertex.tangent[1], vertex.tangent[2]}));
    Vec3 tangent = normalise(along - normal * dot(along, normal));
    if (length(tangent) < 0.5) tangent = frame_about(normal).x;
    const auto [x, y, z] = single(tangent);
    out.push_back({single(position), single(normal), {x, y, z, handedness * vertex.tangent[3]}, vertex.uv});
    if (!is_finite(wide(out.back().position)) || !is_finite(normal)) {
      throw Error(ErrorCode::mesh_invalid,
                  where + ": its transform takes vertices out of the range of numbers");
    }
  }
  return out;
}

// Without triangles that have no area, and with the winding that a mirroring transform asks for.
std::vector<std::uint32_t> sound_triangles(const std::vector<std::uint32_t>& indices,
                                           const std::vector<Vertex>& vertices, bool mirrored) {
  std::vector<std::uint32_t> out;
  out.reserve(indices.size());
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Vec3 a = wide(vertices[indices[i]].position);
    const Vec3 ab = wide(vertices[indices[i + 1]].position) - a,
               ac = wide(vertices[indices[i + 2]].position) - a;
    const double longest = std::max({length(ab), length(ac), length(ac - ab)});
    if (!(length(cross(ab, ac)) > 1e-12 * longest * longest)) continue;
    out.push_back(indices[i]);
    out.push_back(indices[mirrored ? i + 2 : i + 1]);
    out.push_back(indices[mirrored ? i + 1 : i + 2]);
  }
  return out;
}

// Adds one instance for each mesh of a node.
void add_instances(const PlacedNode& placed, MaterialTable& materials, Scene& scene) {
  const std::string where = placed.mesh->file.string() + ": node \"" + placed.node->name + "\"";
  const double volume = determinant(placed.transform);
  for (const int index : placed.node->meshes) {
    if (!is_finite(placed.transform) || volume == 0) {
      throw Error(ErrorCode::mesh_invalid, where + ": its transform is not finite or flattens space");
    }
    const Mesh& mesh = placed.file->meshes[index];
    const int material = materials.index(*placed.mesh, mesh.material);
    if (materials.all()[material].alpha_cutoff >= invisible_cutoff) {
      scene.warnings.push_back(where + ": left out: its material \"" + materials.all()[material].name +
                               "\" is more transparent than its cut-off");
      continue;
    }
    Instance instance{
        placed.node->name, material, transform_vertices(mesh.vertices, placed.transform, where), {}};
    instance.indices = sound_triangles(mesh.indices, instance.vertices, volume < 0);
    if (const std::size_t dropped = (mesh.indices.size() - instance.indices.size()) / 3; dropped > 0) {
      scene.warnings.push_back(where + ": " + std::to_string(dropped) +
                               " triangles without area are left out");
    }
    if (!instance.indices.empty()) scene.instances.push_back(std::move(instance));
  }
}

MeshFiles load_mesh_files(const SceneSpec& spec, TexturePool& textures, std::vector<std::string>& warnings) {
  const bool all_tangents = std::any_of(spec.materials.begin(), spec.materials.end(), [](const auto& m) {
    return m.normal_texture && m.normal_texture->file;
  });
  MeshFiles files;
  for (const MeshSpec& mesh : spec.meshes) {
    const auto [entry, fresh] = files.try_emplace(mesh.file);
    if (!fresh) continue;
    entry->second = load_mesh_file(mesh.file, all_tangents, textures);
    warnings.insert(warnings.end(), entry->second.warnings.begin(), entry->second.warnings.end());
  }
  return files;
}

double radius_of(const std::vector<Instance>& instances) {
  double radius = 0;
  for (const Instance& instance : instances)
    for (const Vertex& vertex : instance.vertices) radius = std::max(radius, length(wide(vertex.position)));
  return radius;
}

}  // namespace

std::size_t Scene::triangle_count() const {
  std::size_t count = 0;
  for (const Instance& instance : instances) count += instance.indices.size() / 3;
  return count;
}

Scene load_scene(const fs::path& json_path) {
  const SceneSpec spec = read_scene_spec(json_path);
  Scene scene;
  TexturePool textures;
  const MeshFiles files = load_mesh_files(spec, textures, scene.warnings);
  const Bounds bounds = bounds_of(place_nodes(spec, files, {}));
  scene.anchor = spec.anchor ? *spec.anchor : bounds.empty() ? Vec3{} : choose_anchor(bounds);
  const std::vector<PlacedNode> nodes = place_nodes(spec, files, scene.anchor);
  MaterialTable materials(spec, files, textures);
  for (const PlacedNode& placed : nodes) add_instances(placed, materials, scene);
  if (scene.instances.empty()) {
    throw Error(ErrorCode::mesh_invalid, json_path.string() + ": the meshes hold no triangle to render");
  }
  for (const std::string& warning : materials.warnings()) scene.warnings.push_back(warning);
  scene.materials = materials.all();
  scene.radius = radius_of(scene.instances);
  scene.camera = choose_camera(spec, nodes, scene.anchor, json_path, scene.warnings);
  scene.lights = collect_lights(spec, nodes, scene.anchor, scene.radius, json_path, scene.warnings);
  scene.textures = textures.take();
  return scene;
}

std::vector<fs::path> scene_files(const fs::path& json_path) {
  const SceneSpec spec = read_scene_spec(json_path);
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
  return files;
}

}  // namespace vsgl::scene
