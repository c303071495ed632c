#include <cmath>
#include <numbers>

#include "interop/model.h"
#include "scene_fixture.h"

namespace vsgl::test {
namespace {

using scene::Scene;

class Gltf : public ::testing::Test {
 protected:
  Scene load(const Json& gltf, const Json& changes = Json::object()) {
    folder.write_json("mesh.gltf", gltf);
    return folder.load(changes);
  }
  void expect_broken(const Json& gltf, const std::vector<std::string>& fragments,
                     ErrorCode code = ErrorCode::mesh_unreadable) {
    expect_error(code, fragments, [&] { load(gltf); });
  }
  SceneFolder folder;
};

TEST_F(Gltf, TriangleWithFlatNormal) {
  const Scene scene = load(triangle_gltf(folder), {{"anchor", {0, 0, 0}}});
  ASSERT_EQ(scene.instances.size(), 1u);
  const auto& instance = scene.instances[0];
  EXPECT_EQ(instance.name, "triangle");
  ASSERT_EQ(instance.indices.size(), 3u);
  expect_near(position(instance, instance.indices[1]), {1, 0, 0}, 0);
  for (std::size_t i = 0; i < 3; ++i) expect_near(normal(instance, i), {0, 0, 1}, 0);
  EXPECT_EQ(scene.radius, 1);
  const auto& material = scene.materials[0];
  EXPECT_EQ(material.name, "paint");
  expect_near(material.base_color, {0.5, 0.25, 0.125}, 1e-7);
  EXPECT_NEAR(material.alpha, 0.25, 1e-7);
  EXPECT_EQ(material.ndf, interop::NDF_GGX);
  expect_near(material.specular, {0.04, 0.04, 0.04}, 1e-12);
}

// Two faces of a tent share their ridge's vertices; each must still get its own normal.
TEST_F(Gltf, AbsentNormalsAreFlatThoughVerticesAreShared) {
  Json gltf = triangle_gltf(folder);
  const std::vector<float> positions{0, 0, 0, 0, 1, 0, 1, 0, -1, -1, 0, -1};
  const std::vector<std::uint16_t> indices{0, 2, 1, 0, 1, 3};
  std::string bytes(reinterpret_cast<const char*>(positions.data()), 48);
  bytes.append(reinterpret_cast<const char*>(indices.data()), 12);
  folder.write("tent.bin", bytes);
  gltf["buffers"][0] = {{"uri", "tent.bin"}, {"byteLength", 60}};
  gltf["bufferViews"] = {{{"buffer", 0}, {"byteLength", 48}},
                         {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 12}}};
  gltf["accessors"] = {{{"bufferView", 0},
                        {"componentType", 5126},
                        {"count", 4},
                        {"type", "VEC3"},
                        {"min", {-1, 0, -1}},
                        {"max", {1, 1, 0}}},
                       {{"bufferView", 1}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}};
  gltf["meshes"][0]["primitives"][0]["indices"] = 1;
  const Scene scene = load(gltf);
  const auto& instance = scene.instances[0];
  ASSERT_EQ(instance.indices.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    expect_near(normal(instance, instance.indices[i]), normalise(face_normal(instance, i / 3 * 3)), 1e-6);
  }
}

TEST_F(Gltf, NodesComposeInDouble) {
  Json gltf = triangle_gltf(folder);
  gltf["nodes"] = {
      {{"name", "parent"}, {"children", {1}}, {"translation", {1e7, 0, 0}}, {"scale", {2, 2, 2}}},
      {{"name", "child"},
       {"mesh", 0},
       {"translation", {0.001, 0, 0}},
       {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}};
  const Scene scene = load(gltf, {{"anchor", {1e7, 0, 0}}});
  const auto& instance = scene.instances[0];
  EXPECT_EQ(instance.name, "child");
  // Single precision would round 1e7 + 0.002 to 1e7.
  expect_near(position(instance, instance.indices[0]), {0.002, 0, 0}, 1e-9);
  expect_near(position(instance, instance.indices[1]), {0.002, 2, 0}, 1e-6);
  expect_near(position(instance, instance.indices[2]), {-1.998, 0, 0}, 1e-6);
}

TEST_F(Gltf, InstancesAndMirroring) {
  Json gltf = triangle_gltf(folder, true, true);
  gltf["scenes"][0]["nodes"] = {0, 1};
  gltf["nodes"] = {{{"name", "plain"}, {"mesh", 0}},
                   {{"name", "mirrored"}, {"mesh", 0}, {"translation", {0, 0, 3}}, {"scale", {-1, 1, 1}}}};
  folder.write("normals.ppm", std::string("P6\n1 1\n255\n\x80\x80\xFF"));
  const Scene scene =
      load(gltf, {{"anchor", {0, 0, 0}}, {"materials", {{"paint", {{"normal_texture", "normals.ppm"}}}}}});
  ASSERT_EQ(scene.instances.size(), 2u);
  for (const auto& instance : scene.instances) {
    expect_near(normalise(face_normal(instance, 0)), {0, 0, 1}, 1e-6);
    for (const auto& vertex : instance.vertices) EXPECT_EQ(vertex.normal[2], 1.0f);
  }
  // The texture's right, and its up by way of the handedness, both as they lie on the surface.
  EXPECT_EQ(scene.instances[0].vertices[0].tangent, (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_EQ(scene.instances[1].vertices[0].tangent, (std::array<float, 4>{-1, 0, 0, -1}));
  const auto& uv = scene.instances[0].vertices[scene.instances[0].indices[2]].uv;
  EXPECT_EQ(uv, (std::array<float, 2>{0, 0}));  // the corner at (0, 1, 0) shows the top left of the picture
}

TEST_F(Gltf, SeveralRootsAndUnequalScaling) {
  Json gltf = triangle_gltf(folder);
  gltf["scenes"][0]["nodes"] = {1, 0};
  gltf["nodes"].push_back({{"name", "second"},
                           {"mesh", 0},
                           {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}},
                           {"scale", {1, 1, 4}}});
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].name, "second");
  expect_near(normal(scene.instances[0], 0), {1, 0, 0}, 1e-6);
  EXPECT_EQ(scene.instances[1].name, "triangle");
}

Json with_lights(Json gltf) {
  gltf["extensionsUsed"] = {"KHR_lights_punctual"};
  gltf["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"},
       {"intensity", 1366},
       {"color", {1, 0.5, 0.25}},
       {"range", 5},
       {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
      {{"type", "directional"}, {"intensity", 683}},
      {{"type", "point"}}};
  const auto node = [](const std::string& name, int light) {
    return Json{{"name", name},
                {"translation", {0, 10, 0}},
                {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}};
  };
  gltf["scenes"][0]["nodes"] = {0, 1, 2, 3, 4};
  for (const Json& light : {node("spot a", 0), node("spot b", 0), node("sun", 1), node("spot a", 2)})
    gltf["nodes"].push_back(light);
  gltf["nodes"][2]["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // -z goes to -y
  return gltf;
}

TEST_F(Gltf, Lights) {
  const Scene scene = load(with_lights(triangle_gltf(folder)), {{"lights", nullptr}, {"anchor", {0, 4, 0}}});
  ASSERT_EQ(scene.lights.size(), 4u);
  const auto& a = scene.lights[0];
  EXPECT_EQ(a.name, "spot a");
  EXPECT_EQ(a.type, LightType::spot);
  expect_near(a.position, {0, 6, 0}, 0);
  expect_near(a.forward, {0, 0, -1}, 1e-15);
  expect_near(a.up, {0, 1, 0}, 1e-15);
  expect_near(a.right, {1, 0, 0}, 1e-15);
  expect_near(a.intensity, {2, 1, 0.5}, 1e-12);  // no attenuation, no factor for the cone
  EXPECT_DOUBLE_EQ(a.cos_inner, std::cos(0.25));
  EXPECT_DOUBLE_EQ(a.cos_outer, std::cos(0.5));
  EXPECT_DOUBLE_EQ(a.extent_x, std::tan(0.5));
  EXPECT_EQ(scene.lights[1].name, "spot b");  // the same light at another node
  expect_near(scene.lights[1].forward, {0, -1, 0}, 1e-15);
  EXPECT_EQ(scene.lights[2].type, LightType::directional);
  expect_near(scene.lights[2].intensity, {1, 1, 1}, 1e-12);
  expect_near(scene.lights[2].position, {0, 0, 0}, 0);
  EXPECT_EQ(scene.lights[3].type, LightType::point);
  EXPECT_EQ(scene.lights[3].name, "spot a-2");
  expect_near(scene.lights[3].forward, {0, 0, -1}, 0);
  EXPECT_TRUE(has_warning(scene, "range"));

  const Scene other =
      load(with_lights(triangle_gltf(folder)), {{"lights", nullptr}, {"lumens_per_watt", 100}});
  EXPECT_NEAR(other.lights[0].intensity.x, 13.66, 1e-12);
}

TEST_F(Gltf, LightErrors) {
  const auto expect_bad = [&](Json light, const std::string& fragment) {
    Json gltf = with_lights(triangle_gltf(folder));
    gltf["extensions"]["KHR_lights_punctual"]["lights"][0].merge_patch(light);
    expect_error(ErrorCode::bad_light, {"scene.json", "spot a", fragment}, [&] {
      load(gltf, {{"lights", nullptr}});
    });
  };
  expect_bad({{"spot", {{"innerConeAngle", 0.6}}}}, "inner cone");
  expect_bad({{"spot", {{"outerConeAngle", 1.57}}}}, "0.01 to 89 degrees");
  expect_error(ErrorCode::bad_light, {"no light"}, [&] {
    load(triangle_gltf(folder), {{"lights", nullptr}});
  });
  Json dark = with_lights(triangle_gltf(folder));
  dark["extensions"]["KHR_lights_punctual"]["lights"][1]["intensity"] = 0;
  const Scene scene = load(dark, {{"lights", nullptr}});
  EXPECT_EQ(scene.lights.size(), 3u);
  EXPECT_TRUE(has_warning(scene, "\"sun\" emits nothing"));
}

Json with_cameras(Json gltf) {
  gltf["cameras"] = {
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}}},
      {{"name", "lens"},
       {"type", "perspective"},
       {"perspective", {{"yfov", 0.8}, {"aspectRatio", 9}, {"znear", 1}}}}};
  gltf["scenes"][0]["nodes"] = {0, 1, 2};
  gltf["nodes"].push_back({{"name", "flat"}, {"camera", 0}});
  gltf["nodes"].push_back({{"name", "view"},
                           {"camera", 1},
                           {"translation", {1, 2, 3}},
                           {"scale", {2, 2, 2}},
                           {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}});
  return gltf;
}

TEST_F(Gltf, Camera) {
  const Json gltf = with_cameras(triangle_gltf(folder));
  for (const Json& camera :
       {Json(nullptr),
        Json{
            {"position", nullptr}, {"target", nullptr}, {"vertical_fov_deg", nullptr}, {"gltf_name", "view"}},
        Json{{"position", nullptr},
             {"target", nullptr},
             {"vertical_fov_deg", nullptr},
             {"gltf_name", "lens"}}}) {
    const Scene scene = load(gltf, {{"camera", camera}, {"anchor", {1, 0, 0}}, {"resolution", {200, 100}}});
    expect_near(scene.camera.position, {0, 2, 3}, 0);
    expect_near(scene.camera.forward, {-1, 0, 0}, 1e-15);
    expect_near(scene.camera.up, {0, 1, 0}, 1e-15);
    expect_near(scene.camera.right, {0, 0, -1}, 1e-15);
    EXPECT_DOUBLE_EQ(scene.camera.tan_y, std::tan(0.4));
    EXPECT_DOUBLE_EQ(scene.camera.tan_x,
                     2 * std::tan(0.4));  // by the resolution, not the file's aspect ratio
    EXPECT_EQ(scene.camera.width, 200);
    EXPECT_EQ(scene.camera.height, 100);
  }
  const auto with_name = [&](const std::string& name) {
    load(
        gltf,
        {{"camera",
          {{"position", nullptr}, {"target", nullptr}, {"vertical_fov_deg", nullptr}, {"gltf_name", name}}}});
  };
  expect_error(ErrorCode::bad_camera, {"no glTF camera is called \"veiw\"", "did you mean \"view\""},
               [&] { with_name("veiw"); });
  expect_error(ErrorCode::bad_camera, {"orthographic"}, [&] { with_name("flat"); });
  expect_error(ErrorCode::bad_camera, {"no camera"}, [&] {
    load(triangle_gltf(folder), {{"camera", nullptr}});
  });
}

TEST_F(Gltf, SpecularExtensionGoesByName) {
  Json gltf = triangle_gltf(folder);
  // The second material is used first: the order in which Assimp hands materials over.
  gltf["materials"].push_back(gltf["materials"][0]);
  gltf["materials"][1]["name"] = "gloss";
  gltf["materials"][1]["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0.5},
                                                                  {"specularColorFactor", {10, 25, 50}}};
  gltf["meshes"].push_back(gltf["meshes"][0]);
  gltf["meshes"][1]["primitives"][0]["material"] = 1;
  gltf["nodes"] = {{{"mesh", 1}}, {{"mesh", 0}}};
  gltf["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = load(gltf);
  ASSERT_EQ(scene.instances.size(), 2u);
  expect_near(scene.materials[scene.instances[0].material].specular, {0.2, 0.5, 0.5}, 1e-12);
  expect_near(scene.materials[scene.instances[1].material].specular, {0.04, 0.04, 0.04}, 1e-12);
}

TEST_F(Gltf, BlendingAndMasks) {
  Json gltf = triangle_gltf(folder);
  gltf["materials"][0]["alphaMode"] = "MASK";
  gltf["materials"][0]["alphaCutoff"] = 0.25;
  EXPECT_NEAR(load(gltf).materials[0].alpha_cutoff, 0.25, 1e-7);
  gltf["materials"][0]["alphaMode"] = "BLEND";
  const Scene blended = load(gltf);
  EXPECT_EQ(blended.materials[0].alpha_cutoff, 0.5);
  EXPECT_TRUE(has_warning(blended, "blending"));
  gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.4;
  expect_broken(gltf, {"no triangle to render"}, ErrorCode::mesh_invalid);  // invisible
}

TEST_F(Gltf, BrokenFiles) {
  const Json good = triangle_gltf(folder);
  ASSERT_NO_THROW(load(good));
  const auto broken = [&](const std::string& pointer, const Json& value,
                          const std::vector<std::string>& fragments) {
    Json gltf = good;
    gltf[Json::json_pointer(pointer)] = value;
    std::vector<std::string> all = fragments;
    all.push_back("mesh.gltf");
    expect_broken(gltf, all);
  };
  broken("/buffers/0/uri", "gone.bin", {"/buffers/0", "gone.bin", "missing"});
  broken("/buffers/0/byteLength", 9999, {"/buffers/0", "9999"});
  broken("/buffers/0/uri", "data:application/octet-stream;base64,AA?A", {"base64"});
  broken("/bufferViews/3/byteOffset", 100, {"/bufferViews/3", "past the end"});
  broken("/bufferViews/0/buffer", 7, {"/bufferViews/0/buffer", "index 7 of 1"});
  broken("/accessors/0/count", 4, {"/accessors/0", "view of 36 bytes"});
  broken("/accessors/0/bufferView", 9, {"/accessors/0/bufferView"});
  broken("/accessors/0", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 2000000000}},
         {"/accessors/0", "too many"});
  broken("/accessors/0/type", "VEC9", {"/accessors/0/type"});
  broken("/accessors/3/componentType", 5126, {"/accessors/3"});
  broken("/meshes/0/primitives/0/indices", 4, {"/meshes/0/primitives/0/indices", "index 4"});
  broken("/meshes/0/primitives/0/attributes/POSITION", 11, {"POSITION"});
  broken("/meshes/0/primitives/0/attributes", {{"NORMAL", 2}}, {"POSITION"});
  broken("/meshes/0/primitives/0/attributes/NORMAL", 3,
         {"wrong type", "/meshes/0/primitives/0/attributes/NORMAL"});
  broken("/nodes/0/children", {0}, {"cycle"});
  broken("/nodes/0/mesh", 5, {});
  broken("/nodes/0/camera", 0, {"/nodes/0/camera"});
  broken("/nodes/0/rotation", {0, 0, 0, 0}, {"/nodes/0/rotation", "quaternion"});
  broken("/scenes/0/nodes/0", 3, {"/scenes/0/nodes/0"});
  broken("/scene", 1, {"/scene"});
  broken("/asset/version", "1.0", {"glTF version 1.0"});
  broken("/extensionsRequired", {"KHR_draco_mesh_compression"}, {"KHR_draco_mesh_compression"});
}

TEST_F(Gltf, IndexOutOfRange) {
  Json gltf = triangle_gltf(folder);
  std::string bytes = "\1\2";
  gltf["accessors"][3]["componentType"] = 5121;
  gltf["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 3}});
  gltf["accessors"][3]["bufferView"] = 4;
  gltf["buffers"].push_back({{"byteLength", 3}, {"uri", "data:;base64,AAED"}});  // 0 1 3
  expect_broken(gltf, {"mesh.gltf", "index 3", "only 3 vertices"});
  gltf["buffers"][1]["uri"] = "data:;base64,AAEC";  // 0 1 2
  ASSERT_NO_THROW(load(gltf));
}

TEST_F(Gltf, NonFiniteVertices) {
  const Json gltf = triangle_gltf(folder);
  std::fstream file(folder / "mesh.bin", std::ios::in | std::ios::out | std::ios::binary);
  const float infinity = std::numeric_limits<float>::infinity();
  file.seekp(12);
  file.write(reinterpret_cast<const char*>(&infinity), sizeof infinity);
  file.close();
  expect_broken(gltf, {"mesh.gltf", "not finite"}, ErrorCode::mesh_invalid);
}

TEST_F(Gltf, BadContainers) {
  const auto expect_glb = [&](const std::string& bytes, const std::string& fragment) {
    folder.write("mesh.glb", bytes);
    const auto path = folder.write_json("scene.json", SceneFolder::basic("mesh.glb"));
    expect_error(ErrorCode::mesh_unreadable, {"mesh.glb", fragment}, [&] { scene::load_scene(path); });
  };
  expect_glb("", "not a .glb");
  expect_glb(std::string("glTF\1\0\0\0\x14\0\0\0\0\0\0\0JSON", 20), "version 1");
  expect_glb(std::string("glTF\2\0\0\0\x99\0\0\0\0\0\0\0JSON", 20), "truncated");
  expect_glb(std::string("glTF\2\0\0\0\x14\0\0\0\x09\0\0\0JSON", 20), "past the end");
  expect_glb(std::string("glTF\2\0\0\0\x18\0\0\0\4\0\0\0BIN\0abcd", 24), "no JSON");
  expect_glb(std::string("glTF\2\0\0\0\x18\0\0\0\4\0\0\0JSON{{{{", 24), "parse error");
}

TEST_F(Gltf, DegenerateTrianglesAreDroppedAndCounted) {
  Json gltf = triangle_gltf(folder);
  gltf["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 6}});
  gltf["accessors"][3] = {{"bufferView", 4}, {"componentType", 5121}, {"count", 6}, {"type", "SCALAR"}};
  gltf["buffers"].push_back({{"byteLength", 6}, {"uri", "data:;base64,AAECAAEB"}});  // 0 1 2 0 1 1
  const Scene scene = load(gltf);
  EXPECT_EQ(scene.triangle_count(), 1u);
  EXPECT_TRUE(has_warning(scene, "1 triangles without area"));
  gltf["nodes"][0]["scale"] = {1, 0, 1};
  expect_broken(gltf, {"flattens"}, ErrorCode::mesh_invalid);
}

}  // namespace
}  // namespace vsgl::test
