#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/error.h"
#include "base/strict_json.h"
#include "interop/model.h"
#include "math/frame.h"
#include "scene/mesh_file.h"
#include "scene/mesh_material.h"
#include "scene/scene.h"
#include "scene/scene_spec.h"
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

// Puts a scene together from its JSON and mesh files.
class Loader {
 public:
  explicit Loader(const fs::path& json_path) : json_path_(json_path), spec_(read_scene_spec(json_path)) {}

  Scene load() {
    const bool all_tangents = std::any_of(spec_.materials.begin(), spec_.materials.end(), [](const auto& m) {
      return m.normal_texture && m.normal_texture->file;
    });
    for (const MeshSpec& mesh : spec_.meshes) {
      if (files_.contains(mesh.file)) continue;
      const MeshFile& file = files_[mesh.file] = load_mesh_file(mesh.file, all_tangents, textures_);
      for (const std::string& warning : file.warnings) scene_.warnings.push_back(warning);
    }
    check_material_names();
    scene_.anchor = spec_.anchor ? *spec_.anchor : choose_anchor(world_bounds());
    for (const MeshSpec& mesh : spec_.meshes) place(mesh);
    if (scene_.instances.empty()) {
      throw Error(ErrorCode::mesh_invalid, json_path_.string() + ": the meshes hold no triangle to render");
    }
    warn_about_materials();
    set_radius();
    set_camera();
    set_lights();
    scene_.textures = textures_.take();
    return std::move(scene_);
  }

 private:
  // Transforms of a file's nodes. Composed from the outside in: with the anchor subtracted first, large
  // offsets cancel before they can swallow digits of anything below them.
  static std::vector<Mat4> node_transforms(const MeshSpec& mesh, const MeshFile& file, Vec3 anchor) {
    Mat4 outer = translation(-anchor);
    for (const Mat4& step : mesh.transforms) outer = outer * step;
    std::vector<Mat4> out;
    for (const MeshNode& node : file.nodes)
      out.push_back((node.parent < 0 ? outer : out[node.parent]) * node.local);
    return out;
  }

  Bounds world_bounds() const {
    Bounds bounds;
    for (const MeshSpec& mesh : spec_.meshes) {
      const MeshFile& file = files_.at(mesh.file);
      const auto transforms = node_transforms(mesh, file, {});
      for (std::size_t n = 0; n < file.nodes.size(); ++n)
        for (const int index : file.nodes[n].meshes)
          for (const Vertex& vertex : file.meshes[index].vertices)
            bounds.add(transforms[n].point(wide(vertex.position)));
    }
    if (bounds.empty()) {
      throw Error(ErrorCode::mesh_invalid, json_path_.string() + ": the meshes hold no triangle to render");
    }
    return bounds;
  }

  // --- Materials ---

  std::vector<std::string> material_names() const {
    std::vector<std::string> names;
    for (const auto& [path, file] : files_)
      for (const Material& material : file.materials) names.push_back(material.name);
    return names;
  }

  void check_material_names() const {
    const std::vector<std::string> loaded = material_names();
    const auto has = [](const std::vector<std::string>& names, const std::string& name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    const auto fail = [](const std::string& where, const std::string& name,
                         const std::vector<std::string>& known) {
      const std::string nearest = nearest_name(name, known);
      throw Error(ErrorCode::json_unknown_key,
                  where + ": no material is called \"" + name + "\"" +
                      (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
    };
    std::vector<std::string> overridden, assigned;
    for (const MaterialOverride& material : spec_.materials) overridden.push_back(material.name);
    for (const MeshSpec& mesh : spec_.meshes) {
      if (!mesh.material) continue;
      assigned.push_back(*mesh.material);
      std::vector<std::string> known = overridden;
      known.insert(known.end(), loaded.begin(), loaded.end());
      if (*mesh.material == "*" || !has(known, *mesh.material))
        fail(mesh.where + "/material", *mesh.material, known);
    }
    for (const MaterialOverride& material : spec_.materials) {
      if (material.name != "*" && !has(loaded, material.name) && !has(assigned, material.name)) {
        fail(material.where, material.name, loaded);
      }
    }
  }

  int texture_index(const TextureOverride& texture, bool srgb) {
    return texture.file ? textures_.add(*texture.file, srgb) : -1;
  }

  // Stating a reflectance makes the surface a dielectric unless the override says otherwise.
  void apply(const MaterialOverride& from, Material& to) {
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

  static void check_material(const std::string& where, const Material& material) {
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
    // A Phong exponent of 65535 is alpha = sqrt(2 / 65537).
    const double minimum =
        material.ndf == interop::NDF_PHONG ? std::sqrt(2 / 65537.0) * (1 - 1e-6) : min_alpha;
    if (has_lobe && !(material.alpha >= minimum && material.alpha <= 1)) {
      fail("its lobe's alpha of " + std::to_string(material.alpha) + " must be from " +
           (material.ndf == interop::NDF_PHONG ? "0.005524 (Phong exponent 65535)" : "0.001") + " to 1");
    }
  }

  // The scene's copy of a material, with all overrides; made on first use.
  int material_index(const std::string& where, const std::string& key, const Material& original) {
    const auto [entry, fresh] = material_of_.try_emplace(key, static_cast<int>(scene_.materials.size()));
    if (!fresh) return entry->second;
    Material material = original;
    for (const MaterialOverride& from : spec_.materials) {
      if (from.name == "*" || from.name == material.name) apply(from, material);
    }
    check_material(where, material);
    scene_.materials.push_back(std::move(material));
    return entry->second;
  }

  int material_of(const MeshSpec& mesh, const MeshFile& file, int index) {
    if (!mesh.material) {
      return material_index(mesh.file.string(), mesh.file.string() + '\n' + std::to_string(index),
                            file.materials[index]);
    }
    Material named;
    named.name = *mesh.material;
    named.specular = {};
    for (const auto& [path, other] : files_)
      for (const Material& candidate : other.materials)
        if (candidate.name == *mesh.material) named = candidate;
    return material_index(mesh.where, '\n' + *mesh.material, named);
  }

  void warn_about_materials() {
    for (const Material& material : scene_.materials) {
      const auto base = to_array(material.base_color), specular = to_array(material.specular);
      for (int c = 0; c < 3; ++c) {
        const double dielectric = 1 - material.metallic;
        const double sum = base[c] * dielectric + specular[c] * dielectric + base[c] * material.metallic;
        if (sum > 1 + 1e-6) {
          scene_.warnings.push_back("material \"" + material.name + "\": diffuse + specular reflectance is " +
                                    std::to_string(sum) + ": it reflects more light than it receives");
          break;
        }
      }
    }
  }

  // --- Instances ---

  void place(const MeshSpec& mesh) {
    const MeshFile& file = files_.at(mesh.file);
    const auto transforms = node_transforms(mesh, file, scene_.anchor);
    for (std::size_t n = 0; n < file.nodes.size(); ++n)
      for (const int index : file.nodes[n].meshes)
        place(mesh, file, file.nodes[n], file.meshes[index], transforms[n]);
  }

  void place(const MeshSpec& spec, const MeshFile& file, const MeshNode& node, const Mesh& mesh,
             const Mat4& transform) {
    const std::string where = spec.file.string() + ": node \"" + node.name + "\"";
    if (!is_finite(transform) || determinant(transform) == 0) {
      throw Error(ErrorCode::mesh_invalid, where + ": its transform is not finite or flattens space");
    }
    Instance out;
    out.name = node.name;
    out.material = material_of(spec, file, mesh.material);
    if (scene_.materials[out.material].alpha_cutoff >= invisible_cutoff) {
      scene_.warnings.push_back(where + ": left out: its material \"" + scene_.materials[out.material].name +
                                "\" is more transparent than its cut-off");
      return;
    }
    out.vertices = transform_vertices(mesh.vertices, transform, where);
    out.indices = sound_triangles(mesh.indices, out.vertices, determinant(transform) < 0, where);
    if (!out.indices.empty()) scene_.instances.push_back(std::move(out));
  }

  static std::vector<Vertex> transform_vertices(const std::vector<Vertex>& vertices, const Mat4& transform,
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
                                             const std::vector<Vertex>& vertices, bool mirrored,
                                             const std::string& where) {
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
    const std::size_t dropped = (indices.size() - out.size()) / 3;
    if (dropped > 0) {
      scene_.warnings.push_back(where + ": " + std::to_string(dropped) +
                                " triangles without area are left out");
    }
    return out;
  }

  void set_radius() {
    scene_.radius = 0;
    for (const Instance& instance : scene_.instances)
      for (const Vertex& vertex : instance.vertices)
        scene_.radius = std::max(scene_.radius, length(wide(vertex.position)));
  }

  // --- Camera and lights ---

  // Calls visit(node, file, transform relative to the anchor) for all nodes of all mesh files, in order.
  template <typename Visit>
  void for_all_nodes(Visit visit) const {
    for (const MeshSpec& mesh : spec_.meshes) {
      const MeshFile& file = files_.at(mesh.file);
      const auto transforms = node_transforms(mesh, file, scene_.anchor);
      for (std::size_t n = 0; n < file.nodes.size(); ++n) visit(file.nodes[n], file, transforms[n]);
    }
  }

  [[noreturn]] void bad_camera(const std::string& what) const {
    throw Error(ErrorCode::bad_camera, json_path_.string() + ": " + what);
  }

  std::optional<Camera> gltf_camera() {
    std::optional<Camera> out;
    std::vector<std::string> names;
    for_all_nodes([&](const MeshNode& node, const MeshFile& file, const Mat4& transform) {
      if (node.camera < 0) return;
      const GltfCamera& source = file.cameras[node.camera];
      names.insert(names.end(), {node.name, source.name});
      if (out || (spec_.gltf_camera && *spec_.gltf_camera != node.name && *spec_.gltf_camera != source.name))
        return;
      if (!source.perspective) {
        if (spec_.gltf_camera)
          bad_camera("camera \"" + source.name +
                     "\" is orthographic; only perspective cameras are supported");
        return;
      }
      out.emplace();
      out->position = transform.point({});
      out->tan_y = std::tan(source.vertical_fov / 2);
      if (!make_frame(transform.direction({0, 0, -1}), transform.direction({0, 1, 0}), out->right, out->up,
                      out->forward)) {
        bad_camera("the transform of camera \"" + node.name + "\" flattens space");
      }
    });
    if (!out && spec_.gltf_camera) {
      const std::string nearest = nearest_name(*spec_.gltf_camera, names);
      bad_camera("no glTF camera is called \"" + *spec_.gltf_camera + "\"" +
                 (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
    }
    if (!spec_.gltf_camera && names.size() > 2) {
      scene_.warnings.push_back(json_path_.string() +
                                ": the files have several cameras; the first perspective one is used");
    }
    return out;
  }

  void set_camera() {
    std::optional<Camera> camera = spec_.camera;
    if (camera) {
      camera->position = camera->position - scene_.anchor;
    } else {
      camera = gltf_camera();
    }
    if (!camera)
      bad_camera("the scene has no camera; give position, target and vertical_fov_deg under \"camera\"");
    camera->width = spec_.width;
    camera->height = spec_.height;
    camera->tan_x = camera->tan_y * spec_.width / spec_.height;
    scene_.camera = *camera;
  }

  LightSource gltf_light(const MeshNode& node, const GltfLight& source, const Mat4& transform) const {
    const auto fail = [&](const std::string& what) {
      throw Error(ErrorCode::bad_light, json_path_.string() + ": light \"" + node.name + "\": " + what);
    };
    LightSource out;
    out.name = node.name;
    out.type = source.type;
    out.position = transform.point({});
    out.intensity = source.intensity / spec_.lumens_per_watt;
    if (out.type == LightType::point) return out;
    if (!make_frame(transform.direction({0, 0, -1}), transform.direction({0, 1, 0}), out.right, out.up,
                    out.forward)) {
      fail("its transform flattens space");
    }
    if (out.type == LightType::spot) {
      if (source.inner_cone > source.outer_cone) fail("the inner cone is wider than the outer one");
      if (source.outer_cone < 1e-4 || source.outer_cone > 1.5533) {
        fail("the outer cone's half angle must be from 0.01 to 89 degrees; use a point light for more");
      }
      out.cos_inner = std::cos(source.inner_cone);
      out.cos_outer = std::cos(source.outer_cone);
      out.extent_x = out.extent_y = std::tan(source.outer_cone);
    }
    return out;
  }

  void add_light(LightSource light) {
    if (light.intensity == Vec3{}) {
      scene_.warnings.push_back(json_path_.string() + ": light \"" + light.name +
                                "\" emits nothing and is left out");
      return;
    }
    if (light.type == LightType::directional) {
      light.position = {};
      light.extent_x = light.extent_y = scene_.radius;
    }
    const std::string name = light.name;
    const auto taken = [&] {
      return std::any_of(scene_.lights.begin(), scene_.lights.end(),
                         [&](const auto& l) { return l.name == light.name; });
    };
    for (int i = 2; taken(); ++i) light.name = name + "-" + std::to_string(i);
    scene_.lights.push_back(std::move(light));
  }

  void set_lights() {
    if (spec_.lights) {
      for (LightSource light : *spec_.lights) {
        light.position = light.position - scene_.anchor;
        add_light(std::move(light));
      }
    } else {
      for_all_nodes([&](const MeshNode& node, const MeshFile& file, const Mat4& transform) {
        if (node.light >= 0) add_light(gltf_light(node, file.lights[node.light], transform));
      });
    }
    if (scene_.lights.empty()) {
      throw Error(
          ErrorCode::bad_light,
          json_path_.string() + ": the scene has no light; add one under \"lights\" or to the glTF file");
    }
  }

  fs::path json_path_;
  SceneSpec spec_;
  std::map<fs::path, MeshFile> files_;
  TexturePool textures_;
  std::map<std::string, int>
      material_of_;  // file and material, or the name of an assigned one, to the scene's index
  Scene scene_;
};

}  // namespace

std::size_t Scene::triangle_count() const {
  std::size_t count = 0;
  for (const Instance& instance : instances) count += instance.indices.size() / 3;
  return count;
}

Scene load_scene(const fs::path& json_path) {
  return Loader(json_path).load();
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
