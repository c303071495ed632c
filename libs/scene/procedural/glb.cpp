#include "scene/procedural/glb.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>

#include "scene/scene_spec.h"

namespace vsgl::scene {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degree = std::numbers::pi / 180;
constexpr double lumens_per_watt = 683;

Json array_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

void append_u32(std::string& bytes, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((value >> shift) & 0xFF);
}

void pad(std::string& bytes, char with) {
  while (bytes.size() % 4 != 0) bytes += with;
}

// Column-major, as glTF wants it.
Json matrix_of(const Mat4& m) {
  Json out = Json::array();
  for (int column = 0; column < 4; ++column)
    for (const auto& row : m.m) out.push_back(row[column]);
  return out;
}

// Looking down its own -z, as glTF's cameras and lights do.
Json view_matrix(const ModelView& view) {
  const Vec3 forward = view.target - view.position;
  const Vec3 up = std::abs(forward.y) > 0.999 * length(forward) ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
  Vec3 x, y, z;
  make_frame(forward, up, x, y, z);
  const Vec3 p = view.position;
  return matrix_of({{{x.x, y.x, -z.x, p.x}, {x.y, y.y, -z.y, p.y}, {x.z, y.z, -z.z, p.z}, {0, 0, 0, 1}}});
}

class GlbWriter {
 public:
  explicit GlbWriter(const Model& model) : model_(model) {}

  std::string write(Vec3 offset, double scale) {
    Json materials = Json::array(), meshes = Json::array();
    for (const ModelMaterial& material : model_.materials) materials.push_back(material_json(material));
    for (const ModelMesh& mesh : model_.meshes) meshes.push_back(mesh_json(mesh));
    Json out;
    out["asset"] = {{"version", "2.0"}, {"generator", "vsgltools scene-gen"}};
    out["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_specular"};
    out["extensions"] = {{"KHR_lights_punctual", {{"lights", Json::array({light_json(scale)})}}}};
    out["scene"] = 0;
    out["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
    out["nodes"] = nodes_json(offset, scale);
    out["cameras"] = Json::array({camera_json(scale)});
    out["materials"] = materials;
    out["meshes"] = meshes;
    if (!images_.empty()) {
      out["images"] = images_;
      out["textures"] = textures_;
    }
    out["accessors"] = accessors_;
    out["bufferViews"] = views_;
    out["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    return container(out.dump());
  }

 private:
  Json nodes_json(Vec3 offset, double scale) const {
    Json root{{"name", "root"}, {"children", Json::array()}};
    if (offset != Vec3{}) root["translation"] = array_of(offset);
    if (scale != 1) root["scale"] = array_of({scale, scale, scale});
    Json nodes = Json::array({root});
    for (const ModelNode& node : model_.nodes) {
      Json entry{{"name", node.name}, {"mesh", node.mesh}};
      if (matrix_of(node.transform) != matrix_of({})) entry["matrix"] = matrix_of(node.transform);
      nodes.push_back(entry);
    }
    nodes.push_back({{"name", "camera"}, {"camera", 0}, {"matrix", view_matrix(model_.camera)}});
    nodes.push_back({{"name", "light"},
                     {"matrix", view_matrix(model_.light)},
                     {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    for (std::size_t i = 1; i < nodes.size(); ++i) nodes[0]["children"].push_back(i);
    return nodes;
  }

  Json camera_json(double scale) const {
    return {{"name", "camera"},
            {"type", "perspective"},
            {"perspective", {{"yfov", model_.camera.fov_deg * degree}, {"znear", 0.01 * scale}}}};
  }

  Json light_json(double scale) const {
    return {{"name", "light"},
            {"type", "spot"},
            {"color", {1, 1, 1}},
            {"intensity", model_.light_intensity_w_sr * scale * scale * lumens_per_watt},
            {"spot",
             {{"innerConeAngle", model_.light_inner_deg * degree},
              {"outerConeAngle", model_.light.fov_deg * degree}}}};
  }

  // The index of the texture that shows an image.
  std::size_t texture(const std::string& image) {
    for (std::size_t i = 0; i < images_.size(); ++i)
      if (images_[i]["uri"] == image) return i;
    textures_.push_back({{"source", images_.size()}});
    images_.push_back({{"uri", image}});
    return images_.size() - 1;
  }

  Json material_json(const ModelMaterial& material) {
    const Vec3 base = material.base_color;
    Json pbr{{"baseColorFactor", {base.x, base.y, base.z, 1}},
             {"metallicFactor", material.metal ? 1 : 0},
             {"roughnessFactor", std::sqrt(material.alpha)}};
    if (!material.base_color_image.empty()) {
      pbr["baseColorTexture"] = {{"index", texture(material.base_color_image)}};
    }
    Json out{{"name", material.name}, {"doubleSided", true}, {"pbrMetallicRoughness", pbr}};
    if (!material.normal_image.empty()) out["normalTexture"] = {{"index", texture(material.normal_image)}};
    if (!material.metal) {
      // 0.04 is the reflectance of glTF's default index of refraction, which the extension tints.
      const Json specular = material.specular == Vec3{}
                                ? Json{{"specularFactor", 0}}
                                : Json{{"specularColorFactor", array_of(material.specular / 0.04)}};
      out["extensions"] = {{"KHR_materials_specular", specular}};
    }
    return out;
  }

  // Appends values to the binary chunk; returns the accessor's index.
  template <typename T>
  std::size_t accessor(const std::vector<T>& values, int component_type, const char* type, int target,
                       const Json& extra = Json::object()) {
    const std::size_t count = values.size(), length = count * sizeof(T);
    views_.push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", length}, {"target", target}});
    binary_.append(reinterpret_cast<const char*>(values.data()), length);
    Json entry{{"bufferView", views_.size() - 1},
               {"componentType", component_type},
               {"count", count},
               {"type", type}};
    entry.update(extra);
    accessors_.push_back(entry);
    return accessors_.size() - 1;
  }

  Json mesh_json(const ModelMesh& mesh) {
    constexpr int floats = 5126, integers = 5125, array_buffer = 34962, element_array_buffer = 34963;
    std::array<float, 3> low = mesh.positions[0], high = low;
    for (const auto& position : mesh.positions)
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], position[i]);
        high[i] = std::max(high[i], position[i]);
      }
    Json attributes;
    attributes["POSITION"] =
        accessor(mesh.positions, floats, "VEC3", array_buffer, {{"min", low}, {"max", high}});
    attributes["NORMAL"] = accessor(mesh.normals, floats, "VEC3", array_buffer);
    if (!mesh.uvs.empty()) attributes["TEXCOORD_0"] = accessor(mesh.uvs, floats, "VEC2", array_buffer);
    const std::size_t indices = accessor(mesh.indices, integers, "SCALAR", element_array_buffer);
    return {
        {"name", mesh.name},
        {"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", mesh.material}}}}};
  }

  std::string container(std::string text) {
    pad(text, ' ');
    pad(binary_, '\0');
    std::string out = "glTF";
    append_u32(out, 2);
    append_u32(out, 12 + 8 + text.size() + 8 + binary_.size());
    append_u32(out, text.size());
    out += "JSON" + text;
    append_u32(out, binary_.size());
    out.append("BIN\0", 4);
    return out + binary_;
  }

  const Model& model_;
  Json images_ = Json::array(), textures_ = Json::array(), accessors_ = Json::array(), views_ = Json::array();
  std::string binary_;
};

}  // namespace

std::string write_glb(const Model& model, Vec3 offset, double scale) {
  return GlbWriter(model).write(offset, scale);
}

}  // namespace vsgl::scene
