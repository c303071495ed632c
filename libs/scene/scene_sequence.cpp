#include "scene/scene_sequence.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/animation.h"
#include "scene/instances.h"
#include "scene/material_table.h"
#include "scene/mesh_material.h"
#include "scene/texture.h"

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

// The centre of the box rounded to a grid of about a millionth of its half diagonal, a power of two, so that
// subtracting it rounds few vertices. The two odd constants keep decimal sizes off the points where rounding
// changes its mind.
Vec3 snapped_centre(const Bounds& bounds) {
  const double half_diagonal = length(bounds.high - bounds.low) / 2;
  const double grid = std::exp2(std::floor(std::log2(std::max(half_diagonal, 1e-30) * 1.1371)) - 20);
  const auto snap = [grid](double low, double high) {
    return grid * std::floor((low + high) / 2 / grid + 0.5 + 0.1237);
  };
  return {snap(bounds.low.x, bounds.high.x), snap(bounds.low.y, bounds.high.y),
          snap(bounds.low.z, bounds.high.z)};
}

// Those that serve as nothing else, with a warning where much of one was not unit.
void normalise_normal_maps(Scene& scene) {
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const auto used_as = [&](int Material::*kind) {
      return std::any_of(scene.materials.begin(), scene.materials.end(),
                         [&](const Material& m) { return m.*kind == static_cast<int>(i); });
    };
    if (!used_as(&Material::normal_texture) || used_as(&Material::base_color_texture) ||
        used_as(&Material::metallic_roughness_texture))
      continue;
    if (normalise_normal_map(scene.textures[i]) > 0.01)
      scene.warnings.push_back(scene.textures[i].name +
                               ": normals that are not unit vectors were normalised");
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

bool is_equal(const Mat4& a, const Mat4& b) {
  for (int i = 0; i < 4; ++i)
    if (!std::equal(a.m[i], a.m[i] + 4, b.m[i])) return false;
  return true;
}

// The document of every frame, read. Throws what read_scene_spec() throws.
std::vector<SceneSpec> read_frames(const fs::path& json_path, const JsonValue& document,
                                   const Animation& animation) {
  read_scene_spec(document, json_path.parent_path());  // faults that are in the file itself
  std::vector<SceneSpec> specs;
  for (int frame = 0; frame < animation.frames(); ++frame)
    specs.push_back(read_scene_spec(animation.at(frame), json_path.parent_path()));
  return specs;
}

// Calls `visit` with each vertex, relative to the anchor, of all nodes at the first frame and of those that
// have moved at the others.
template <class Visit>
void for_each_vertex(const std::vector<SceneSpec>& specs, const MeshFiles& files, Vec3 anchor,
                     bool meshes_move, Visit visit) {
  const auto first = place_nodes(specs.front(), files, anchor);
  for (std::size_t frame = 0; frame < (meshes_move ? specs.size() : 1); ++frame) {
    const auto nodes = place_nodes(specs[frame], files, anchor);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (frame > 0 && is_equal(nodes[i].transform, first[i].transform)) continue;
      for (const int mesh : nodes[i].node->meshes)
        for (const Vertex& vertex : nodes[i].file->meshes[mesh].vertices)
          visit(nodes[i].transform.point(position_of(vertex)));
    }
  }
}

// Where the scene's own origin is, as far as its first mesh tells: its outermost transform, if that does not
// turn it, or else the world's.
Vec3 scene_origin(const SceneSpec& spec, const MeshFiles& files) {
  if (spec.meshes.empty()) return {};
  const MeshSpec& mesh = spec.meshes.front();
  const std::vector<MeshNode>& nodes = files.at(mesh.file).nodes;
  if (mesh.transforms.empty() && nodes.empty()) return {};
  const Mat4& outermost = mesh.transforms.empty() ? nodes.front().local : mesh.transforms.front();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j && outermost.m[i][j] != 0) return {};
  return outermost.point({});
}

double radius_of(const std::vector<Instance>& instances) {
  double radius = 0;
  for (const Instance& instance : instances)
    for (const Vertex& vertex : instance.vertices) radius = std::max(radius, length(position_of(vertex)));
  return radius;
}

}  // namespace

struct SceneSequence::State {
  // A mesh of a node, which becomes an instance.
  struct Part {
    std::size_t node;
    const Mesh* mesh;
    int material;
  };

  fs::path json_path;
  Animation animation;
  std::vector<SceneSpec> specs;  // of each frame
  MeshFiles files;
  Scene common;  // what all frames share: anchor, radius, materials, textures, warnings
  std::vector<PlacedNode> first_nodes;
  std::vector<Part> parts;
  std::vector<Instance> first_instances;  // of each part, at frame 0

  State(const fs::path& path, const JsonValue& document)
      : json_path(path), animation(document), specs(read_frames(path, document, animation)) {
    TexturePool textures;
    files = load_mesh_files(specs.front(), textures, common.warnings);
    common.anchor = anchor();
    first_nodes = place_nodes(specs.front(), files, common.anchor);
    MaterialTable materials(specs.front(), files, textures);
    for (std::size_t node = 0; node < first_nodes.size(); ++node) add_parts(node, materials);
    if (std::all_of(first_instances.begin(), first_instances.end(),
                    [](const Instance& instance) { return instance.indices.empty(); })) {
      throw Error(ErrorCode::mesh_invalid, json_path.string() + ": the meshes hold no triangle to render");
    }
    for (const std::string& warning : materials.warnings()) common.warnings.push_back(warning);
    common.materials = materials.all();
    common.textures = textures.take();
    normalise_normal_maps(common);
    common.radius = radius();
  }

  // Found from the scene's own origin: where the scene was moved as a whole, the anchor keeps its place in
  // it, and positions relative to it are the same numbers.
  Vec3 anchor() const {
    if (specs.front().anchor) return *specs.front().anchor;
    const Vec3 origin = scene_origin(specs.front(), files);
    Bounds bounds;
    for_each_vertex(specs, files, origin, animation.moves_meshes(), [&](Vec3 p) { bounds.add(p); });
    return bounds.empty() ? Vec3{} : origin + snapped_centre(bounds);
  }

  double radius() const {
    double radius = radius_of(first_instances);
    if (animation.moves_meshes())
      for_each_vertex(specs, files, common.anchor, true,
                      [&](Vec3 p) { radius = std::max(radius, length(p)); });
    return radius;
  }

  void add_parts(std::size_t node, MaterialTable& materials) {
    const PlacedNode& placed = first_nodes[node];
    for (const int index : placed.node->meshes) {
      const Mesh& mesh = placed.file->meshes[index];
      const int material = materials.index(*placed.mesh, mesh.material);
      if (materials.all()[material].alpha_cutoff >= invisible_cutoff) {
        common.warnings.push_back(where(placed) + ": left out: its material \"" +
                                  materials.all()[material].name + "\" is more transparent than its cut-off");
        continue;
      }
      Instance instance = make_instance(placed, mesh, material);
      if (const std::size_t dropped = (mesh.indices.size() - instance.indices.size()) / 3; dropped > 0) {
        common.warnings.push_back(where(placed) + ": " + std::to_string(dropped) +
                                  " triangles without area are left out");
      }
      parts.push_back({node, &mesh, material});
      first_instances.push_back(std::move(instance));
    }
  }

  // Calls `visit` with each part that has triangles, and its instance.
  template <class Visit>
  void for_each_instance(const std::vector<PlacedNode>& nodes, Visit visit) const {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& [node, mesh, material] = parts[i];
      const bool moved = !is_equal(nodes[node].transform, first_nodes[node].transform);
      Instance instance = moved ? make_instance(nodes[node], *mesh, material) : first_instances[i];
      if (!instance.indices.empty()) visit(parts[i], std::move(instance));
    }
  }

  std::vector<PlacedNode> nodes_at(int frame) const {
    const int frames = animation.frames();
    if (frame < 0 || frame >= frames) {
      throw Error(ErrorCode::out_of_range, json_path.string() + ": there is no frame " +
                                               std::to_string(frame) + "; the scene has the frames 0 to " +
                                               std::to_string(frames - 1));
    }
    return place_nodes(specs[frame], files, common.anchor);
  }
};

SceneSequence::SceneSequence(const fs::path& json_path)
    : state_(std::make_unique<State>(json_path, JsonValue::parse_file(json_path))) {}
SceneSequence::~SceneSequence() = default;
SceneSequence::SceneSequence(SceneSequence&&) noexcept = default;
SceneSequence& SceneSequence::operator=(SceneSequence&&) noexcept = default;

int SceneSequence::frames() const {
  return state_->animation.frames();
}

double SceneSequence::frame_rate_hz() const {
  return state_->animation.frame_rate_hz();
}

Scene SceneSequence::at(int frame) const {
  const State& s = *state_;
  const auto nodes = s.nodes_at(frame);
  const SceneSpec& spec = s.specs[frame];
  Scene scene = s.common;
  s.for_each_instance(nodes, [&](const State::Part&, Instance&& instance) {
    scene.instances.push_back(std::move(instance));
  });
  scene.camera = choose_camera(spec, nodes, scene.anchor, s.json_path, scene.warnings);
  scene.environment = spec.environment;
  scene.sphere_lights = spec.sphere_lights;
  for (SphereLight& sphere : scene.sphere_lights) sphere.position = sphere.position - scene.anchor;
  scene.lights = collect_lights(spec, nodes, scene.anchor, scene.radius, s.json_path, scene.warnings);
  return scene;
}

std::vector<InstanceOrigin> SceneSequence::origins(int frame) const {
  const auto nodes = state_->nodes_at(frame);
  std::vector<InstanceOrigin> out;
  state_->for_each_instance(nodes, [&](const State::Part& part, const Instance&) {
    out.push_back({part.mesh, nodes[part.node].transform});
  });
  return out;
}

}  // namespace vsgl::scene
