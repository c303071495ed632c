#pragma once

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../expect_error.h"
#include "scene/scene.h"

namespace vsgl::test {

using Json = nlohmann::ordered_json;

// A folder with scene and mesh files of a test's own.
class SceneFolder {
 public:
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  std::filesystem::path write_json(const std::string& name, const Json& json) const {
    write(name, json.dump());
    return folder_ / name;
  }

  // Writes `scene` over the defaults below and loads it.
  scene::Scene load(const Json& changes) const {
    Json scene = basic();
    scene.merge_patch(changes);
    return scene::load_scene(write_json("scene.json", scene));
  }

  // One mesh file, a spot light and a camera.
  static Json basic(const std::string& mesh = "mesh.gltf") {
    return {{"$schema", "vsgltools/scene/1"},
            {"meshes", Json::array({{{"file", mesh}}})},
            {"lights", Json::array({spot()})},
            {"camera", {{"position", {0, 0, 5}}, {"target", {0, 0, 0}}, {"vertical_fov_deg", 40}}}};
  }
  static Json spot() {
    return {{"name", "lamp"},
            {"type", "spot"},
            {"position", {0, 5, 0}},
            {"target", {0, 0, 0}},
            {"radiant_intensity_w_sr", 10},
            {"outer_cone_deg", 30}};
  }

 private:
  TemporaryFolder folder_;
};

// A right triangle in the plane z = 0, its normal +z: (0,0,0), (1,0,0), (0,1,0), with indices and, if asked
// for, texture coordinates equal to (x, 1 - y), that is, a picture whose top is up. One node "triangle" shows
// it.
inline Json triangle_gltf(const SceneFolder& folder, bool uvs = false, bool normals = false) {
  const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0}, coordinates{0, 1, 1, 1, 0, 0},
      up{0, 0, 1, 0, 0, 1, 0, 0, 1};
  const std::vector<std::uint16_t> indices{0, 1, 2, 0};  // the last pads
  std::string bytes;
  const auto append = [&](const auto& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
  };
  append(positions);
  append(coordinates);
  append(up);
  append(indices);
  folder.write("mesh.bin", bytes);
  Json attributes{{"POSITION", 0}};
  if (uvs) attributes["TEXCOORD_0"] = 1;
  if (normals) attributes["NORMAL"] = 2;
  const auto view = [](int offset, int length) {
    return Json{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
  };
  return {{"asset", {{"version", "2.0"}}},
          {"scene", 0},
          {"scenes", Json::array({{{"nodes", Json::array({0})}}})},
          {"nodes", Json::array({{{"name", "triangle"}, {"mesh", 0}}})},
          {"materials", Json::array({{{"name", "paint"},
                                      {"pbrMetallicRoughness",
                                       {{"baseColorFactor", {0.5, 0.25, 0.125, 1}},
                                        {"metallicFactor", 0},
                                        {"roughnessFactor", 0.5}}}}})},
          {"meshes",
           Json::array({{{"name", "one"},
                         {"primitives",
                          Json::array({{{"attributes", attributes}, {"indices", 3}, {"material", 0}}})}}})},
          {"accessors",
           Json::array({{{"bufferView", 0},
                         {"componentType", 5126},
                         {"count", 3},
                         {"type", "VEC3"},
                         {"min", {0, 0, 0}},
                         {"max", {1, 1, 0}}},
                        {{"bufferView", 1}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}},
                        {{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
                        {{"bufferView", 3}, {"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}}})},
          {"bufferViews", Json::array({view(0, 36), view(36, 24), view(60, 36), view(96, 8)})},
          {"buffers", Json::array({{{"uri", "mesh.bin"}, {"byteLength", bytes.size()}}})}};
}

inline Vec3 position(const scene::Instance& instance, std::size_t i) {
  const auto& p = instance.vertices[i].position;
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}
inline Vec3 normal(const scene::Instance& instance, std::size_t i) {
  const auto& n = instance.vertices[i].normal;
  return {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
}
// Of the triangle that starts at indices[first], towards its counter-clockwise side; length twice the area.
inline Vec3 face_normal(const scene::Instance& instance, std::size_t first) {
  const Vec3 a = position(instance, instance.indices[first]);
  return cross(position(instance, instance.indices[first + 1]) - a,
               position(instance, instance.indices[first + 2]) - a);
}

inline void expect_near(Vec3 value, Vec3 expected, double error) {
  EXPECT_LE(length(value - expected), error) << value.x << " " << value.y << " " << value.z << " is not "
                                             << expected.x << " " << expected.y << " " << expected.z;
}

inline bool has_warning(const scene::Scene& scene, const std::string& fragment) {
  for (const std::string& warning : scene.warnings)
    if (warning.find(fragment) != std::string::npos) return true;
  return false;
}

}  // namespace vsgl::test
