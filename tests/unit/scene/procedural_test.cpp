#include "scene/procedural.h"

#include <cmath>
#include <map>
#include <numbers>

#include "interop/model.h"
#include "scene/scene_sequence.h"
#include "scene_fixture.h"

namespace vsgl::test {
namespace {

using scene::GeneratedScene;
using scene::GenerateOptions;
using scene::Scene;

class Procedural : public ::testing::Test {
 protected:
  GeneratedScene generate(const std::string& name, const GenerateOptions& options = {}) {
    return scene::generate_scene(name, options, folder / "", "made");
  }
  Scene load(const std::string& name, const GenerateOptions& options = {}) {
    for (const auto& file : generate(name, options).files) folder.write(file.name, file.bytes);
    return scene::load_scene(folder / "made.json");
  }
  static GenerateOptions triangles(int count) {
    GenerateOptions options;
    options.triangles = count;
    return options;
  }
  SceneFolder folder;
};

const scene::Instance& named(const Scene& scene, const std::string& name) {
  for (const auto& instance : scene.instances)
    if (instance.name == name) return instance;
  throw std::runtime_error("no instance " + name);
}

TEST_F(Procedural, EveryScene) {
  for (const auto& [name, summary] : scene::generators()) {
    SCOPED_TRACE(name);
    const GeneratedScene first = generate(name), second = generate(name);
    ASSERT_EQ(first.files.size(), second.files.size());
    for (std::size_t i = 0; i < first.files.size(); ++i)
      EXPECT_EQ(first.files[i].bytes, second.files[i].bytes);

    const Scene scene = load(name);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_EQ(scene.triangle_count(), first.triangles);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, LightType::spot);
    EXPECT_LT(scene.lights[0].cos_outer, scene.lights[0].cos_inner);
    // Fronts and normals are on one side, so that a renderer that culls sees the same as one that does not.
    for (const auto& instance : scene.instances)
      for (std::size_t i = 0; i < instance.indices.size(); i += 3)
        for (int corner = 0; corner < 3; ++corner) {
          const Vec3 face = normalise(face_normal(instance, i));
          ASSERT_GT(dot(face, normal(instance, instance.indices[i + corner])), 0.2) << instance.name;
        }
  }
  expect_error(ErrorCode::bad_value, {"cornel", "cornell"}, [&] { generate("cornel"); });
}

class ProceduralOffset : public Procedural, public testing::WithParamInterface<Vec3> {};

TEST_P(ProceduralOffset, KeepsEveryBit) {
  GenerateOptions moved;
  moved.offset = GetParam();
  for (const auto& [name, summary] : scene::generators()) {
    SCOPED_TRACE(name);
    const Scene near = load(name), far = load(name, moved);
    EXPECT_EQ(far.anchor, near.anchor + moved.offset);
    EXPECT_EQ(far.radius, near.radius);
    EXPECT_EQ(far.camera.position, near.camera.position);
    EXPECT_EQ(far.camera.forward, near.camera.forward);
    EXPECT_EQ(far.lights[0].position, near.lights[0].position);
    EXPECT_EQ(far.lights[0].forward, near.lights[0].forward);
    EXPECT_EQ(far.lights[0].intensity, near.lights[0].intensity);
    ASSERT_EQ(far.instances.size(), near.instances.size());
    for (std::size_t i = 0; i < near.instances.size(); ++i) {
      EXPECT_EQ(near.instances[i].indices, far.instances[i].indices);
      ASSERT_EQ(near.instances[i].vertices.size(), far.instances[i].vertices.size());
      EXPECT_EQ(std::memcmp(near.instances[i].vertices.data(), far.instances[i].vertices.data(),
                            near.instances[i].vertices.size() * sizeof(scene::Vertex)),
                0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Places, ProceduralOffset,
                         testing::Values(Vec3{1000, 1000, 1000}, Vec3{0.1, 1.7, -0.03}, Vec3{100000.1, -33333.33, 1.7},
                                         Vec3{1000000.1, 1000000.1, 1000000.1}));

TEST_F(Procedural, ScaleKeepsRadiance) {
  GenerateOptions big;
  big.scale = 4;
  const Scene one = load("cornell"), four = load("cornell", big);
  EXPECT_NEAR(four.radius, 4 * one.radius, 1e-5 * four.radius);  // the anchor snaps to another grid
  expect_near(four.camera.position + four.anchor, 4 * (one.camera.position + one.anchor), 1e-12);
  expect_near(four.lights[0].position + four.anchor, 4 * (one.lights[0].position + one.anchor), 1e-12);
  EXPECT_NEAR(four.lights[0].intensity.x, 16 * one.lights[0].intensity.x, 1e-9);
}

TEST_F(Procedural, CornellBoxAsPublished) {
  const Scene scene = load("cornell");
  EXPECT_EQ(scene.triangle_count(), 30u);  // 5 walls and 2 blocks of 5 faces
  Vec3 low{1e9, 1e9, 1e9}, high = -low;
  for (const auto& instance : scene.instances)
    for (std::size_t i = 0; i < instance.vertices.size(); ++i) {
      const Vec3 p = position(instance, i) + scene.anchor;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  expect_near(low, {0, 0, 0}, 1e-7);
  expect_near(high, {0.556, 0.5488, 0.5592}, 1e-7);
  expect_near(scene.camera.position + scene.anchor, {0.278, 0.273, -0.8}, 1e-12);
  expect_near(scene.camera.forward, {0, 0, 1}, 1e-12);
  EXPECT_NEAR(scene.camera.tan_x, 12.5 / 35, 1e-12);
  EXPECT_NEAR(scene.camera.tan_y, 12.5 / 35, 1e-12);
  const auto reflectance = [&](const std::string& name) {
    return scene.materials[named(scene, name).material].base_color;
  };
  EXPECT_GT(reflectance("left wall").x, 5 * reflectance("left wall").y);    // red
  EXPECT_GT(reflectance("right wall").y, 3 * reflectance("right wall").x);  // green
  // The camera's right is -x: the red wall, at large x, is on its left.
  EXPECT_NEAR(scene.camera.right.x, -1, 1e-12);
  EXPECT_GT(position(named(scene, "left wall"), 0).x, position(named(scene, "right wall"), 0).x);
  for (const auto& material : scene.materials) EXPECT_EQ(material.specular, Vec3{});
  for (const auto& name : {"short block", "tall block"})
    for (std::size_t i = 0; i < 30; i += 3) {  // every face looks away from the block's axis
      const auto& block = named(scene, name);
      Vec3 centre;
      for (std::size_t v = 0; v < block.vertices.size(); ++v)
        centre += position(block, v) / static_cast<double>(block.vertices.size());
      EXPECT_GT(dot(face_normal(block, i), position(block, block.indices[i]) - centre), 0);
    }
}

// Every edge of the room belongs to two triangles but for the open front, every edge of a block but for its
// underside.
TEST_F(Procedural, CornellBoxIsClosed) {
  const Scene scene = load("cornell");
  std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> edges;
  for (const auto& instance : scene.instances)
    for (std::size_t i = 0; i < instance.indices.size(); ++i) {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
      auto a = instance.vertices[instance.indices[i]].position,
           b = instance.vertices[instance.indices[next]].position;
      ++edges[std::minmax(a, b)];
    }
  int open = 0;
  for (const auto& [edge, count] : edges) {
    ASSERT_LE(count, 2);
    if (count == 2) continue;
    ++open;
    const auto on = [&](int axis, double at) {
      const double anchor = axis == 1 ? scene.anchor.y : scene.anchor.z;
      return std::abs(static_cast<double>(edge.first[axis]) + anchor - at) < 1e-6 &&
             std::abs(static_cast<double>(edge.second[axis]) + anchor - at) < 1e-6;
    };
    EXPECT_TRUE(on(2, 0) || on(1, 0));
  }
  EXPECT_EQ(open, 4 + 2 * 4);
}

TEST_F(Procedural, GlossyMaterials) {
  GenerateOptions options;
  const Scene ggx = load("cornell-glossy", options);
  const auto& floor = ggx.materials[named(ggx, "floor").material];
  EXPECT_EQ(floor.alpha, 0.2);
  EXPECT_EQ(floor.ndf, interop::NDF_GGX);
  EXPECT_GT(floor.specular.x, 0);
  options.exponent = 65535;
  const Scene ring = load("caustic-ring", options);
  const auto& metal = ring.materials[named(ring, "ring").material];
  EXPECT_EQ(metal.ndf, interop::NDF_PHONG);
  EXPECT_EQ(metal.alpha, std::sqrt(2 / 65537.0));
  EXPECT_EQ(metal.metallic, 1);
  options = {};
  options.ndf = "beckmann";
  options.alpha = 0.07;
  EXPECT_EQ(load("cornell-glossy", options).materials[named(ggx, "floor").material].ndf,
            interop::NDF_BECKMANN);
  options.exponent = 5;
  expect_error(ErrorCode::conflicting_options, {"--exponent"}, [&] { generate("caustic-ring", options); });
}

// The caustic's cusp: light along -x at height h that meets the ring's inside at angle a leaves towards the
// axis and crosses y = 0 beyond the half radius; the light must come in at the height and steepness for that.
TEST_F(Procedural, CausticRing) {
  const Scene scene = load("caustic-ring");
  EXPECT_EQ(scene.triangle_count(), 518u);
  const auto& ring = named(scene, "ring");
  for (std::size_t i = 0; i < ring.vertices.size(); ++i) {
    const Vec3 p = position(ring, i) + scene.anchor;
    const double radius = std::hypot(p.x, p.z);
    EXPECT_TRUE(std::abs(radius - 1) < 1e-6 || std::abs(radius - 1.06) < 1e-6);
    EXPECT_LT(p.x, 1e-6);
    const Vec3 n = normal(ring, i);
    if (std::abs(n.y) < 0.5 && std::abs(p.x) > 1e-3) {
      EXPECT_NEAR(std::abs(n.x * p.x + n.z * p.z) / radius, 1, 1e-5);  // radial
    }
  }
  const Vec3 light = scene.lights[0].position + scene.anchor;
  const double steepness =
      (light.y - 0.25) / (light.x + 1);  // of the ray to the middle of the wall, at (-1, 0.25, 0)
  EXPECT_LT(0.25 / steepness, 1.0);      // it lands between the wall and the axis
  EXPECT_GT(0.5 / steepness, 0.5);       // and that of the rim beyond the cusp
}

TEST_F(Procedural, AtriumFollowsItsBudget) {
  for (const int budget : {6000, 20000, 100000, 264000}) {
    const auto count = static_cast<double>(generate("atrium", triangles(budget)).triangles);
    EXPECT_LE(count, budget);
    EXPECT_GE(count, 0.85 * budget) << budget;
  }
  expect_error(ErrorCode::out_of_range, {"--triangles"}, [&] { generate("atrium", triangles(100)); });
}

TEST_F(Procedural, AtriumTextures) {
  const Scene scene = load("atrium", triangles(5000));
  ASSERT_EQ(scene.textures.size(), 4u);
  for (const auto& name : {"floor", "walls"}) {
    const auto& instance = named(scene, name);
    const auto& material = scene.materials[instance.material];
    ASSERT_GE(material.base_color_texture, 0);
    ASSERT_GE(material.normal_texture, 0);
    EXPECT_TRUE(scene.textures[material.base_color_texture].srgb);
    const auto& normals = scene.textures[material.normal_texture];
    EXPECT_EQ(normals.width, 512);
    Vec3 mean;
    for (std::size_t i = 0; i < normals.rgba.size(); i += 4) {
      mean += Vec3{normals.rgba[i] / 255.0, normals.rgba[i + 1] / 255.0, normals.rgba[i + 2] / 255.0} * 2 -
              Vec3{1, 1, 1};
    }
    mean = mean / (512.0 * 512);
    EXPECT_NEAR(mean.x, 0, 0.02);  // a seamless height field has no slope on average
    EXPECT_NEAR(mean.y, 0, 0.02);
    EXPECT_GT(mean.z, 0.7);
    EXPECT_LT(mean.z, 0.995);
    // Tangents lie in the surface, along growing u.
    for (std::size_t i = 0; i < instance.indices.size(); i += 3) {
      const auto& a = instance.vertices[instance.indices[i]];
      const auto& b = instance.vertices[instance.indices[i + 1]];
      const Vec3 tangent{static_cast<double>(a.tangent[0]), static_cast<double>(a.tangent[1]),
                         static_cast<double>(a.tangent[2])};
      const Vec3 edge = position(instance, instance.indices[i + 1]) - position(instance, instance.indices[i]);
      if (b.uv[1] == a.uv[1]) {
        EXPECT_GT(dot(tangent, normalise(edge)) * static_cast<double>(b.uv[0] - a.uv[0]), 0);
      }
      EXPECT_EQ(a.tangent[3], 1.0f);  // green up
    }
  }
  GenerateOptions other = triangles(5000);
  other.seed = 1;
  const GeneratedScene first = generate("atrium", triangles(5000)), second = generate("atrium", other);
  EXPECT_EQ(first.files[1].bytes, second.files[1].bytes);
  EXPECT_NE(first.files[2].bytes, second.files[2].bytes);
}

TEST_F(Procedural, AtriumWithGlmark2Textures) {
  GenerateOptions options = triangles(5000);
  options.texture_dir = "/usr/share/glmark2/textures";
  ASSERT_TRUE(std::filesystem::exists(options.texture_dir)) << "install glmark2-data (make setup)";
  const Scene scene = load("atrium", options);
  const auto& floor = scene.materials[named(scene, "floor").material];
  EXPECT_NE(scene.textures[floor.base_color_texture].name.find("grasslight-512.jpg"), std::string::npos);
  EXPECT_NE(scene.textures[floor.normal_texture].name.find("grasslight-512-nm.jpg"), std::string::npos);
  EXPECT_EQ(generate("atrium", options).files.size(), 2u);
}

TEST_F(Procedural, MeshStandsInTheBox) {
  folder.write("step.obj",
               std::string("v 10 2 0\nv 14 2 0\nv 14 4 0\nv 10 4 0\nv 12 2 1\nf 1 2 3 4\nf 1 2 5\n"));
  GenerateOptions options;
  options.mesh = folder / "step.obj";
  options.mesh_material = "metal";
  options.offset = {16, 0, 0};
  const Scene scene = load("cornell", options);
  EXPECT_EQ(scene.triangle_count(), 10u + 3u);
  const auto& mesh = scene.instances.back();
  EXPECT_EQ(scene.materials[mesh.material].metallic, 1);
  Vec3 low{1e9, 1e9, 1e9}, high = -low;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 p = position(mesh, i) + scene.anchor - options.offset;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  EXPECT_NEAR(low.y, 0, 1e-6);              // on the floor
  EXPECT_NEAR(high.y, 0.33 * 2 / 4, 1e-6);  // 4 wide, 2 high
  EXPECT_GT(low.x, 0.05);
  EXPECT_LT(high.x, 0.5);

  options.mesh_material = "wood";
  expect_error(ErrorCode::bad_value, {"--mesh-material", "diffuse"}, [&] { generate("cornell", options); });
  options.mesh_material = "diffuse";
  expect_error(ErrorCode::conflicting_options, {"--mesh"}, [&] { generate("atrium", options); });
  options.mesh = folder / "gone.obj";
  expect_error(ErrorCode::file_not_found, {"gone.obj"}, [&] { generate("cornell", options); });
}

TEST_F(Procedural, OptionErrors) {
  const auto fails = [&](ErrorCode code, const std::string& flag, const auto& change) {
    GenerateOptions options;
    change(options);
    expect_error(code, {flag}, [&] { generate("caustic-ring", options); });
  };
  fails(ErrorCode::out_of_range, "--scale", [](auto& o) { o.scale = 0; });
  fails(ErrorCode::out_of_range, "--alpha", [](auto& o) { o.alpha = 1e-4; });
  fails(ErrorCode::out_of_range, "--exponent", [](auto& o) { o.exponent = 65536; });
  fails(ErrorCode::out_of_range, "--offset",
        [](auto& o) { o.offset.y = std::numeric_limits<double>::infinity(); });
  fails(ErrorCode::conflicting_options, "--alpha", [](auto& o) { o.alpha = 0.1, o.exponent = 2; });
  fails(ErrorCode::conflicting_options, "--texture-dir", [](auto& o) { o.texture_dir = "/"; });
}

class Moving : public Procedural {
 protected:
  scene::SceneSequence sequence(const std::string& name, const GenerateOptions& options) {
    for (const auto& file : generate(name, options).files) folder.write(file.name, file.bytes);
    return scene::SceneSequence(folder / "made.json");
  }
  static GenerateOptions moving(const std::string& what, int frames) {
    GenerateOptions options;
    options.animate = what;
    options.frames = frames;
    return options;
  }
};

class MovingEach : public Moving, public ::testing::WithParamInterface<const char*> {};

TEST_P(MovingEach, ThereAndBackInEveryScene) {
  for (const auto& [name, summary] : scene::generators()) {
    SCOPED_TRACE(name);
    const Scene still = load(name);
    const auto frames = sequence(name, moving(GetParam(), 130));
    EXPECT_EQ(frames.frames(), 130);
    const Scene first = frames.at(0), turn = frames.at(64), back = frames.at(128);
    EXPECT_TRUE(first.warnings.empty()) << first.warnings.front();
    expect_near(first.camera.position + first.anchor, still.camera.position + still.anchor, 1e-12);
    expect_near(first.camera.forward, still.camera.forward, 1e-12);
    EXPECT_NEAR(first.camera.tan_y, still.camera.tan_y, 1e-12);
    expect_near(first.lights[0].position + first.anchor, still.lights[0].position + still.anchor, 1e-12);
    expect_near(first.lights[0].forward, still.lights[0].forward, 1e-12);
    EXPECT_NEAR(first.lights[0].cos_outer, still.lights[0].cos_outer, 1e-12);
    EXPECT_NEAR(first.lights[0].intensity.x, still.lights[0].intensity.x, 1e-9);
    const auto state = [](const Scene& scene) {
      const Vec3 p = scene.camera.position, d = scene.lights[0].forward;
      return std::vector<double>{p.x,
                                 p.y,
                                 p.z,
                                 d.x,
                                 d.y,
                                 d.z,
                                 position(scene.instances.back(), 0).x,
                                 position(scene.instances.back(), 0).z};
    };
    EXPECT_EQ(state(back), state(first));
    EXPECT_NE(state(turn), state(first));
    EXPECT_NE(state(frames.at(1)), state(first));
  }
}
INSTANTIATE_TEST_SUITE_P(What, MovingEach, ::testing::Values("light", "camera", "object"));

TEST_F(Moving, AsFastAsPromised) {
  const auto light = sequence("cornell", moving("light", 64));
  for (int i = 1; i < 64; ++i)
    EXPECT_NEAR(dot(light.at(i).lights[0].forward, light.at(i - 1).lights[0].forward),
                std::cos(0.25 * std::numbers::pi / 180), 1e-12);
  const auto shorter = sequence("cornell", moving("light", 97));
  expect_near(shorter.at(96).lights[0].forward, shorter.at(32).lights[0].forward, 1e-12);
  GenerateOptions bright = moving("light", 2);
  bright.scale = 3;
  EXPECT_NEAR(sequence("cornell", bright).at(0).lights[0].intensity.x, 9 * 2, 1e-9);
  GenerateOptions large = moving("camera", 3);
  large.height = 100;
  large.scale = 3;
  large.offset = {5, 6, 7};
  const auto camera = sequence("cornell", large);
  const Scene first = camera.at(0), next = camera.at(1);
  const double distance = 3 * 0.8;  // to the box's front, where the camera looks at
  expect_near(next.camera.position - first.camera.position,
              first.camera.right * (2 * first.camera.tan_y * distance / 100), 1e-12);
  EXPECT_EQ(next.camera.forward, first.camera.forward);
  const auto object = sequence("cornell", moving("object", 64));
  const Vec3 way = position(object.at(63).instances.back(), 0) - position(object.at(0).instances.back(), 0);
  const double cone_radius =
      0.3 * std::sqrt(0.162 * 0.162 + 0.54 * 0.54 + 0.09 * 0.09) * std::tan(28 * std::numbers::pi / 180);
  EXPECT_NEAR(length(way), 2 * cone_radius * 63 / 64, 1e-6);
}

TEST_F(Moving, BadOptions) {
  GenerateOptions still;
  still.frames = 8;
  expect_error(ErrorCode::conflicting_options, {"--frames", "--animate"},
               [&] { generate("cornell", still); });
  expect_error(ErrorCode::out_of_range, {"--frames", "10000"},
               [&] { generate("cornell", moving("light", 1)); });
}

}  // namespace
}  // namespace vsgl::test
