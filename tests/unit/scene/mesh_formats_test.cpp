#include <cmath>

#include "interop/model.h"
#include "scene_fixture.h"

namespace vsgl::test {
namespace {

namespace fs = std::filesystem;
using scene::Scene;

class MeshFormats : public ::testing::Test {
 protected:
  Scene load(const std::string& mesh, const Json& changes = Json::object()) {
    Json json = SceneFolder::basic(mesh);
    json.merge_patch(changes);
    return scene::load_scene(folder.write_json("scene.json", json));
  }
  SceneFolder folder;
};

constexpr const char* obj_quad =
    "mtllib quad.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl shiny\nf "
    "1/1 2/2 3/3 4/4\n";

TEST_F(MeshFormats, ObjWithMaterialLibrary) {
  folder.write("quad.obj", obj_quad);
  folder.write("quad.mtl", "newmtl shiny\nKd 0.5 0.25 0.125\nKs 0.25 0.25 0.25\nNs 98\nmap_Kd quad.ppm\n");
  folder.write("quad.ppm", std::string("P6\n1 2\n255\n\xFF\x00\x00\x00\x00\xFF", 17));
  const Scene scene = load("quad.obj");
  EXPECT_EQ(scene.triangle_count(), 2u);
  EXPECT_EQ(scene.instances[0].vertices.size(), 4u);  // joined
  const auto& material = scene.materials[scene.instances[0].material];
  EXPECT_EQ(material.name, "shiny");
  expect_near(material.base_color, {0.5, 0.25, 0.125}, 1e-7);
  expect_near(material.specular, {0.25, 0.25, 0.25}, 1e-7);
  EXPECT_EQ(material.ndf, interop::NDF_PHONG);
  EXPECT_NEAR(material.alpha, std::sqrt(2 / 100.0), 1e-7);
  EXPECT_EQ(material.metallic, 0);
  ASSERT_EQ(material.base_color_texture, 0);
  EXPECT_TRUE(scene.textures[0].srgb);
  EXPECT_EQ(scene.textures[0].rgba,
            (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 255}));  // red on top
  for (const auto& vertex : scene.instances[0].vertices) {
    const float centred = vertex.position[1] + static_cast<float>(scene.anchor.y);
    EXPECT_EQ(vertex.uv[1], 1 - centred);  // v = 0 is the top of the picture
  }

  const auto files = scene::scene_files(folder / "scene.json");
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"scene.json", "quad.obj", "quad.mtl", "quad.ppm"}));
}

// Names in another encoding than UTF-8 must not spoil the tools' JSON.
TEST_F(MeshFormats, NamesBecomeUtf8) {
  folder.write("quad.obj", obj_quad);
  folder.write("quad.mtl", "newmtl sh\xEFny\nKd 0.7 0.7 0.7\nKs 0.7 0.7 0.7\n");
  folder.write("quad.obj", std::string(obj_quad).replace(std::string(obj_quad).find("shiny"), 5, "sh\xEFny"));
  const Scene scene = load("quad.obj");
  EXPECT_EQ(scene.materials[0].name, "sh\xEF\xBF\xBDny");
  EXPECT_TRUE(has_warning(scene, "\"sh\xEF\xBF\xBDny\""));
}

TEST_F(MeshFormats, ObjWithoutItsLibraryIsDiffuse) {
  folder.write("quad.obj", obj_quad);
  const Scene scene = load("quad.obj");
  EXPECT_TRUE(has_warning(scene, "quad.mtl is missing"));
  EXPECT_EQ(scene.materials[0].specular, Vec3{});
}

// Faces that meet at a right angle keep their edge; those of a shallow roof are smoothed.
TEST_F(MeshFormats, AbsentNormalsKeepSharpEdges) {
  folder.write("step.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\nf 1 2 3 4\nf 2 5 6 3\n");
  const Scene sharp = load("step.obj");
  for (const auto& vertex : sharp.instances[0].vertices)
    EXPECT_EQ(std::abs(vertex.normal[0]) + std::abs(vertex.normal[2]), 1.0f);
  folder.write("step.obj",
               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 -0.5\nv 2 1 -0.5\nf 1 2 3 4\nf 2 5 6 3\n");
  const Scene smooth = load("step.obj");
  EXPECT_EQ(smooth.instances[0].vertices.size(), 6u);  // both faces share the ridge's vertices
}

TEST_F(MeshFormats, Ply) {
  folder.write(
      "triangle.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n");
  const Scene scene = load("triangle.ply");
  EXPECT_EQ(scene.triangle_count(), 1u);
  expect_near(normal(scene.instances[0], 0), {0, 0, 1}, 0);
  EXPECT_EQ(scene.materials[0].specular, Vec3{});
}

TEST_F(MeshFormats, BrokenFiles) {
  const auto expect_broken = [&](const std::string& name, const std::string& bytes, ErrorCode code) {
    folder.write(name, bytes);
    expect_error(code, {name}, [&] { load(name); });
  };
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  expect_broken("index.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n", ErrorCode::mesh_unreadable);
  expect_broken("nan.ply", header + "0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n", ErrorCode::mesh_invalid);
  // Files of this kind crash Assimp 5.2 or keep it busy forever.
  const auto expect_bad_ply = [&](std::string text, const std::string& from, const std::string& to,
                                  const std::string& fragment) {
    SCOPED_TRACE(to);
    ASSERT_NE(text.find(from), std::string::npos);
    folder.write("bad.ply", text.replace(text.find(from), from.size(), to));
    expect_error(ErrorCode::mesh_unreadable, {"bad.ply", fragment}, [&] { load("bad.ply"); });
  };
  const std::string good = header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  expect_bad_ply(good, "end_header", "end`header", "not understood");
  expect_bad_ply(good, "element vertex 3", "elem8nt vertex 3", "not understood");
  expect_bad_ply(good, "element face", "element 9999999999face", "not understood");
  expect_bad_ply(good, "float x", "flaot x", "unknown type");
  expect_bad_ply(good, "element vertex 3", "element vertex 99999999999", "ends too early");
  expect_bad_ply(good, "3 0 1 2", "3 0 1", "ends too early");
  expect_bad_ply(good, "3 0 1 2", "3 0 1 -1", "vertex -1 of 3");
  expect_bad_ply(good, "3 0 1 2", "-3 0 1 2", "negative length");
  expect_bad_ply(good, "1 0 0", "1 zero 0", "not a number");
  expect_bad_ply(good, "format ascii 1.0\n", "", "format");
  expect_bad_ply(good, "format ascii", "format binary_little_endian", "element");
  expect_broken("empty.ply", "", ErrorCode::mesh_unreadable);
  expect_broken("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n", ErrorCode::mesh_unreadable);
  expect_broken("model.stl", "solid\nendsolid\n", ErrorCode::mesh_unreadable);
  expect_error(ErrorCode::mesh_unreadable, {"model.stl", ".gltf, .glb, .obj and .ply"},
               [&] { load("model.stl"); });
  expect_error(ErrorCode::file_not_found, {"gone.obj"}, [&] { load("gone.obj"); });
  // Assimp's reader miscounts the kinds of such faces, on which its triangulation would abort.
  folder.write("mixed.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1\nf 1 2\nf 1 2 3\n");
  EXPECT_EQ(load("mixed.obj").triangle_count(), 1u);
  folder.write("points.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  expect_error(ErrorCode::mesh_invalid, {"no triangle"}, [&] { load("points.obj"); });
}

// Whatever Debian's assimp-testmodels holds of these formats loads soundly or ends in an Error, the malformed
// ones among them.
TEST_F(MeshFormats, AssimpTestModels) {
  const fs::path models = "/usr/share/assimp/models";
  ASSERT_TRUE(fs::is_directory(models)) << "install assimp-testmodels (make setup)";
  int loaded = 0, refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(models)) {
    const std::string extension = entry.path().extension();
    if (extension != ".gltf" && extension != ".glb" && extension != ".obj" && extension != ".ply") continue;
    Json json = SceneFolder::basic(entry.path().string());
    json["materials"]["*"] = {{"alpha", 0.5}};
    const auto path = folder.write_json("scene.json", json);
    try {
      const Scene scene = scene::load_scene(path);
      ++loaded;
      EXPECT_GT(scene.triangle_count(), 0u) << entry.path();
      for (const auto& instance : scene.instances) {
        for (const std::uint32_t index : instance.indices)
          ASSERT_LT(index, instance.vertices.size()) << entry.path();
        for (std::size_t i = 0; i < instance.vertices.size(); ++i) {
          ASSERT_NEAR(length(normal(instance, i)), 1, 1e-5) << entry.path();
          ASSERT_LE(length(position(instance, i)), scene.radius * (1 + 1e-9)) << entry.path();
        }
      }
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(error.exit(), Exit::input) << entry.path() << ": " << error.what();
    }
  }
  EXPECT_GE(loaded, 40);
  EXPECT_GE(refused, 20);
}

TEST_F(MeshFormats, AssimpMalformedModels) {
  const std::string models = "/usr/share/assimp/models/";
  ASSERT_TRUE(fs::is_directory(models)) << "install assimp-testmodels (make setup)";
  const auto refused = [&](const std::string& name, ErrorCode code) {
    SCOPED_TRACE(name);
    expect_error(code, {fs::path(name).filename().string()}, [&] { load(models + name); });
  };
  refused("glTF2/IndexOutOfRange/IndexOutOfRange.gltf", ErrorCode::mesh_unreadable);
  refused("glTF2/IndexOutOfRange/AllIndicesOutOfRange.gltf", ErrorCode::mesh_unreadable);
  refused("glTF2/MissingBin/BoxTextured.gltf", ErrorCode::mesh_unreadable);
  refused("glTF2/RecursiveNodes/RecursiveNodes.gltf", ErrorCode::mesh_unreadable);
  refused("glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", ErrorCode::mesh_invalid);
  refused("glTF2/wrongTypes/badUint.gltf", ErrorCode::mesh_unreadable);
  refused("invalid/malformed.obj", ErrorCode::mesh_unreadable);
  refused("invalid/empty.ply", ErrorCode::mesh_unreadable);
}

}  // namespace
}  // namespace vsgl::test
