#include "scene/gltf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "scene/gltf_file.h"
#include "scene/transform.h"

namespace vsgl::scene {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void broken(const JsonValue& value, const std::string& what) {
  throw Error(ErrorCode::mesh_unreadable, value.where() + ": " + what);
}

std::vector<JsonValue> items(const JsonValue& object, const std::string& key) {
  const auto list = object.find(key);
  return list ? list->array() : std::vector<JsonValue>{};
}

std::string name_of(const JsonValue& object, const std::string& fallback) {
  const auto name = object.find("name");
  return name && !name->string().empty() ? name->string() : fallback;
}

double number_or(const JsonValue& object, const std::string& key, double fallback, double minimum,
                 double maximum) {
  const auto value = object.find(key);
  return value ? value->number(minimum, maximum) : fallback;
}

Vec3 vec3_or(const JsonValue& object, const std::string& key, Vec3 fallback) {
  const auto value = object.find(key);
  return value ? to_vec3(value->numbers<3>()) : fallback;
}

std::optional<JsonValue> extension(const JsonValue& object, const std::string& name) {
  const auto extensions = object.find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

Mat4 local_transform(const JsonValue& node) {
  if (const auto matrix = node.find("matrix")) {
    const auto values = matrix->numbers<16>();
    Mat4 out;
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) out.m[row][column] = values[4 * column + row];
    return out;
  }
  Mat4 out = translation(vec3_or(node, "translation", {}));
  if (const auto value = node.find("rotation")) {
    auto quaternion = value->numbers<4>();
    double norm = 0;
    for (const double component : quaternion) norm += component * component;
    if (!(norm > 0)) broken(*value, "a zero quaternion is no rotation");
    for (double& component : quaternion) component /= std::sqrt(norm);
    out = out * rotation(quaternion);
  }
  return out * scaling(vec3_or(node, "scale", {1, 1, 1}));
}

GltfNode read_node(const JsonValue& value, std::size_t index, const GltfDocument& document) {
  GltfNode node;
  node.name = name_of(value, "node" + std::to_string(index));
  node.local = local_transform(value);
  for (const JsonValue& child : items(value, "children")) {
    node.children.push_back(static_cast<int>(child.integer(0, 0x7FFFFFFF)));
  }
  const auto reference = [](const JsonValue& owner, const std::string& key, std::size_t count) {
    const auto found = owner.find(key);
    if (!found) return -1;
    return static_cast<int>(found->integer(0, static_cast<std::int64_t>(count) - 1));
  };
  node.camera = reference(value, "camera", document.cameras.size());
  if (const auto light = extension(value, "KHR_lights_punctual")) {
    node.light = reference(*light, "light", document.lights.size());
  }
  return node;
}

GltfCamera read_camera(const JsonValue& value, std::size_t index) {
  GltfCamera camera;
  camera.name = name_of(value, "camera" + std::to_string(index));
  camera.perspective = value.at("type").choice({"perspective", "orthographic"}) == "perspective";
  if (camera.perspective) {
    camera.vertical_fov = value.at("perspective").at("yfov").number(1e-4, std::numbers::pi - 1e-4);
  }
  return camera;
}

GltfLight read_light(const JsonValue& value, std::size_t index, std::vector<std::string>& warnings) {
  GltfLight light;
  light.name = name_of(value, "light" + std::to_string(index));
  const std::string type = value.at("type").choice({"directional", "point", "spot"});
  light.type = type == "directional" ? LightType::directional
               : type == "spot"      ? LightType::spot
                                     : LightType::point;
  light.intensity = vec3_or(value, "color", {1, 1, 1}) * number_or(value, "intensity", 1, 0, 1e30);
  if (light.type == LightType::spot) {
    const JsonValue cone = value.at("spot");
    light.inner_cone = number_or(cone, "innerConeAngle", 0, 0, std::numbers::pi / 2);
    light.outer_cone = number_or(cone, "outerConeAngle", std::numbers::pi / 4, 0, std::numbers::pi / 2);
  }
  if (value.find("range"))
    warnings.push_back(value.where() + ": the range is ignored: light falls off with 1/r^2 only");
  return light;
}

// KHR_materials_specular, with glTF's index of refraction of 1.5: 0.04 at normal incidence, tinted and
// scaled.
std::optional<Vec3> read_specular(const JsonValue& material) {
  const auto specular = extension(material, "KHR_materials_specular");
  if (!specular) return std::nullopt;
  const Vec3 colour = vec3_or(*specular, "specularColorFactor", {1, 1, 1});
  const double factor = number_or(*specular, "specularFactor", 1, 0, 1);
  const auto reflectance = [&](double tint) { return std::min(0.04 * tint, 1.0) * factor; };
  return Vec3{reflectance(colour.x), reflectance(colour.y), reflectance(colour.z)};
}

// Materials of one name cannot be told apart.
void add_specular(const JsonValue& material, GltfDocument& out) {
  const auto specular = read_specular(material);
  if (!specular) return;
  const auto [entry, fresh] = out.specular.try_emplace(name_of(material, ""), *specular);
  if (!fresh && entry->second != *specular) {
    out.warnings.push_back(material.where() + ": several materials are called \"" + entry->first +
                           "\"; all take the specular reflectance of the first");
  }
}

// The image files that a material's base-colour, metallic-roughness and normal textures refer to.
void collect_images(const JsonValue& json, const JsonValue& material, const fs::path& folder,
                    std::vector<fs::path>& files) {
  const auto textures = items(json, "textures"), images = items(json, "images");
  const auto add = [&](const std::optional<JsonValue>& slot) {
    if (!slot) return;
    const auto& texture = textures.at(static_cast<std::size_t>(
        slot->at("index").integer(0, static_cast<std::int64_t>(textures.size()) - 1)));
    const auto source = texture.find("source");
    if (!source) broken(texture, "the texture has no image");
    const auto& image =
        images.at(static_cast<std::size_t>(source->integer(0, static_cast<std::int64_t>(images.size()) - 1)));
    const auto uri = image.find("uri");
    if (!uri || uri->string().starts_with("data:")) return;
    const fs::path file = folder / decode_percent(uri->string());
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  };
  if (const auto pbr = material.find("pbrMetallicRoughness")) {
    add(pbr->find("baseColorTexture"));
    add(pbr->find("metallicRoughnessTexture"));
  }
  add(material.find("normalTexture"));
}

void warn_about_features(const JsonValue& json, std::vector<std::string>& warnings) {
  static const std::vector<std::string> honoured{"KHR_lights_punctual", "KHR_materials_specular"};
  for (const JsonValue& name : items(json, "extensionsUsed")) {
    if (std::find(honoured.begin(), honoured.end(), name.string()) == honoured.end()) {
      warnings.push_back(name.where() + ": the extension " + name.string() + " is ignored");
    }
  }
  if (!items(json, "animations").empty() || !items(json, "skins").empty()) {
    warnings.push_back(json.where() + ": animations and skins are ignored: meshes stand in their rest pose");
  }
}

GltfDocument read_document(const fs::path& path) {
  const GltfFile file = read_gltf_file(path);
  const JsonValue& json = file.json;
  GltfDocument out;
  out.files = file.buffer_files;
  warn_about_features(json, out.warnings);
  const auto cameras = items(json, "cameras");
  for (std::size_t i = 0; i < cameras.size(); ++i) out.cameras.push_back(read_camera(cameras[i], i));
  if (const auto punctual = extension(json, "KHR_lights_punctual")) {
    const auto lights = items(*punctual, "lights");
    for (std::size_t i = 0; i < lights.size(); ++i)
      out.lights.push_back(read_light(lights[i], i, out.warnings));
  }
  for (const JsonValue& material : items(json, "materials")) {
    add_specular(material, out);
    collect_images(json, material, path.parent_path(), out.files);
  }
  const auto nodes = items(json, "nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) out.nodes.push_back(read_node(nodes[i], i, out));

  const auto scenes = items(json, "scenes");
  if (scenes.empty()) broken(json, "the file has no scene");
  const auto chosen = json.find("scene");
  const auto last = static_cast<std::int64_t>(scenes.size()) - 1;
  for (const JsonValue& root :
       items(scenes[chosen ? static_cast<std::size_t>(chosen->integer(0, last)) : 0], "nodes")) {
    out.roots.push_back(static_cast<int>(root.integer(0, static_cast<std::int64_t>(nodes.size()) - 1)));
  }
  return out;
}

}  // namespace

GltfDocument read_gltf(const fs::path& path) {
  try {
    return read_document(path);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::file_not_found) throw;
    throw Error(ErrorCode::mesh_unreadable, error.what());
  }
}

}  // namespace vsgl::scene
