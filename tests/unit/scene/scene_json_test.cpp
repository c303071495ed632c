#include <cmath>
#include <numbers>

#include "interop/model.h"
#include "scene/sphere_light.h"
#include "scene_fixture.h"

namespace vsgl::test {
namespace {

using scene::Scene;

class SceneJson : public ::testing::Test {
 protected:
  SceneJson() { folder.write_json("mesh.gltf", triangle_gltf(folder, true)); }
  void expect_bad(ErrorCode code, const Json& changes, std::vector<std::string> fragments) {
    SCOPED_TRACE(changes.dump());
    fragments.push_back("scene.json");
    expect_error(code, fragments, [&] { folder.load(changes); });
  }
  static Json mesh(const Json& members) {
    Json out{{"file", "mesh.gltf"}};
    out.merge_patch(members);
    return {{"meshes", Json::array({out})}, {"anchor", {0, 0, 0}}};
  }
  static Json light(const Json& changes) {
    Json out = SceneFolder::spot();
    out.merge_patch(changes);
    return {{"lights", Json::array({out})}, {"anchor", {0, 0, 0}}};
  }
  static Json paint(const Json& members) { return {{"materials", {{"paint", members}}}}; }
  SceneFolder folder;
};

TEST_F(SceneJson, Syntax) {
  folder.write("scene.json", "{\"$schema\": ");
  expect_error(ErrorCode::json_syntax, {"scene.json"}, [&] { scene::load_scene(folder / "scene.json"); });
  expect_error(ErrorCode::file_not_found, {"gone.json"}, [&] { scene::load_scene(folder / "gone.json"); });
  expect_bad(ErrorCode::wrong_schema, {{"$schema", "vsgltools/scene/2"}}, {"vsgltools/scene/1"});
  expect_bad(ErrorCode::json_missing_key, {{"$schema", nullptr}}, {"$schema"});
  expect_bad(ErrorCode::json_missing_key, {{"meshes", nullptr}}, {"meshes"});
  expect_bad(ErrorCode::json_unknown_key, {{"light", 1}}, {"light", "lights"});
  expect_bad(ErrorCode::json_wrong_type, {{"meshes", 1}}, {"/meshes"});
  expect_bad(ErrorCode::json_out_of_range, {{"meshes", Json::array()}}, {"/meshes"});
  expect_bad(ErrorCode::json_out_of_range, {{"resolution", {0, 5}}}, {"/resolution/0"});
  expect_bad(ErrorCode::json_out_of_range, {{"lumens_per_watt", 0}}, {"/lumens_per_watt"});
}

TEST_F(SceneJson, Transforms) {
  const auto first_edge = [&](const Json& transform) {
    const auto scene = folder.load(mesh({{"transform", transform}}));
    const auto& instance = scene.instances[0];
    return std::pair{position(instance, instance.indices[0]), position(instance, instance.indices[1])};
  };
  auto [a, b] = first_edge({{"translation", {1, 2, 3}}, {"rotation_deg", {0, 90, 0}}, {"scale", 2}});
  expect_near(a, {1, 2, 3}, 0);
  expect_near(b, {1, 2, 1}, 0);  // x goes to -z; exact for right angles
  std::tie(a, b) = first_edge({{"rotation_deg", {90, 0, 90}}});
  expect_near(b, {0, 1, 0}, 0);
  std::tie(a, b) = first_edge({{"rotation_deg", {0, 30, 60}}});  // y before z
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  expect_near(b, {c * 0.5, c * std::sin(std::numbers::pi / 3), -s}, 1e-7);
  std::tie(a, b) = first_edge({{"quaternion", {0, 0, 2, 2}}});  // normalised: 90 degrees about z
  expect_near(b, {0, 1, 0}, 1e-7);
  std::tie(a, b) = first_edge({{"scale", {3, 1, 1}}});
  expect_near(b, {3, 0, 0}, 0);
  std::tie(a, b) = first_edge({{"matrix", {0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1}}});
  expect_near(a, {5, 6, 7}, 0);
  expect_near(b, {5, 7, 7}, 0);
  std::tie(a, b) = first_edge(
      {{{"translation", {1, 0, 0}}}, {{"scale", 2}}, {{"translation", {0, 1, 0}}}});  // outermost first
  expect_near(a, {1, 2, 0}, 0);

  const auto bad = [&](ErrorCode code, const Json& transform, const std::string& fragment) {
    expect_bad(code, mesh({{"transform", transform}}), {"/meshes/0/transform", fragment});
  };
  bad(ErrorCode::json_out_of_range, {{"rotation_deg", {0, 0, 0}}, {"quaternion", {0, 0, 0, 1}}}, "either");
  bad(ErrorCode::json_out_of_range, {{"quaternion", {0, 0, 0, 0}}}, "zero quaternion");
  bad(ErrorCode::json_out_of_range, {{"scale", 0}}, "flattens");
  bad(ErrorCode::json_out_of_range, {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1}}},
      "last row");
  bad(ErrorCode::json_unknown_key,
      {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"scale", 1}}, "scale");
  bad(ErrorCode::json_unknown_key, {{"translate", {0, 0, 0}}}, "translation");
  bad(ErrorCode::json_out_of_range, {{"translation", {0, 0}}}, "translation");
}

// Moved as a whole, by transforms around those that are there or as part of them.
TEST_F(SceneJson, OffsetsKeepEveryBit) {
  const Vec3 offset{100000.1, -3000, 33333.33};
  const Json tilt{{"rotation_deg", {10, 20, 30}}, {"translation", {0.1, 0.2, 0.3}}};
  const auto load = [&](const Json& transforms) {
    return folder.load({{"meshes", {{{"file", "mesh.gltf"}, {"transform", transforms}}}}});
  };
  const auto moved_by = [](Vec3 place) { return Json{{"translation", {place.x, place.y, place.z}}}; };
  const Vec3 own{0.1, 0.2, 0.3};
  const std::pair<Json, Json> pairs[] = {{Json{tilt}, {moved_by(offset), tilt}},
                                         {{moved_by(own), tilt}, {moved_by(own + offset), tilt}}};
  for (const auto& [here, there] : pairs) {
    const Scene near = load(here), far = load(there);
    EXPECT_LT(length(far.anchor - near.anchor - offset), 1e-10);
    EXPECT_EQ(far.radius, near.radius);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(near.instances[0].vertices[i].position, far.instances[0].vertices[i].position);
      EXPECT_EQ(near.instances[0].vertices[i].normal, far.instances[0].vertices[i].normal);
    }
  }
}

TEST_F(SceneJson, MaterialOverrides) {
  const auto material = [&](const Json& changes) { return folder.load(changes).materials.at(0); };
  auto m = material(
      paint({{"diffuse", {0.1, 0.2, 0.3}}, {"specular", 0.4}, {"alpha", 0.02}, {"ndf", "beckmann"}}));
  EXPECT_EQ(m.base_color, (Vec3{0.1, 0.2, 0.3}));
  EXPECT_EQ(m.specular, (Vec3{0.4, 0.4, 0.4}));
  EXPECT_EQ(m.alpha, 0.02);
  EXPECT_EQ(m.ndf, interop::NDF_BECKMANN);
  EXPECT_EQ(m.metallic, 0);

  m = material(paint({{"phong_exponent", 65535}}));
  EXPECT_EQ(m.ndf, interop::NDF_PHONG);
  EXPECT_EQ(m.alpha, std::sqrt(2 / 65537.0));
  m = material(paint({{"roughness", 0.5}, {"metallic", 0.75}, {"alpha_cutoff", 0.1}, {"normal_scale", 2}}));
  EXPECT_EQ(m.alpha, 0.25);
  EXPECT_EQ(m.metallic, 0.75);
  EXPECT_EQ(m.alpha_cutoff, 0.1);
  EXPECT_EQ(m.normal_scale, 2);
  expect_near(m.base_color, {0.5, 0.25, 0.125}, 1e-7);  // kept

  // A name wins over "*", whichever stands first.
  m = material({{"materials", {{"paint", {{"alpha", 0.1}}}, {"*", {{"alpha", 0.2}, {"specular", 0}}}}}});
  EXPECT_EQ(m.alpha, 0.1);
  EXPECT_EQ(m.specular, Vec3{});

  // A mesh may take a material that only the JSON has.
  Json assigned = mesh({{"material", "gold"}});
  assigned["materials"] = {{"gold", {{"diffuse", 0.5}, {"metallic", 1}, {"alpha", 0.1}}}};
  m = material(assigned);
  EXPECT_EQ(m.name, "gold");
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.base_color, (Vec3{0.5, 0.5, 0.5}));

  // A stated reflectance makes glTF's metal a dielectric, unless it says metallic as well.
  Json gltf = triangle_gltf(folder);
  gltf["materials"][0]["pbrMetallicRoughness"].erase("metallicFactor");
  folder.write_json("mesh.gltf", gltf);
  EXPECT_EQ(material(paint({{"alpha", 0.5}})).metallic, 1);
  EXPECT_EQ(material(paint({{"specular", 0.1}})).metallic, 0);
  EXPECT_EQ(material(paint({{"diffuse", 0.1}, {"metallic", 1}})).metallic, 1);

  EXPECT_TRUE(has_warning(folder.load(paint({{"diffuse", 0.7}, {"specular", 0.4}})), "1.1"));
}

TEST_F(SceneJson, SphereLights) {
  const auto spheres = [](const Json& changes) {
    Json out{{"position", {1, 2, 3}}, {"radius_m", 0.5}, {"radiance_w_m2_sr", {1, 2, 3}}};
    out.merge_patch(changes);
    return Json{{"sphere_lights", Json::array({out})}};
  };
  Json lamp = spheres({{"name", "lamp"}});
  lamp["anchor"] = {1, 0, 0};
  const auto lights = folder.load(lamp).sphere_lights;
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0].name, "lamp");
  EXPECT_EQ(lights[0].radius, 0.5);
  expect_near(lights[0].position, {0, 2, 3}, 0);
  expect_near(lights[0].radiance, {1, 2, 3}, 0);
  expect_bad(ErrorCode::json_out_of_range, spheres({{"radius_m", 0}}), {"/sphere_lights/0/radius_m"});
  expect_bad(ErrorCode::json_out_of_range, spheres({{"radiance_w_m2_sr", -1}}), {"radiance_w_m2_sr"});
  expect_bad(ErrorCode::json_missing_key, spheres({{"position", nullptr}}), {"position"});
  expect_bad(ErrorCode::json_unknown_key, spheres({{"radius", 1}}), {"radius", "radius_m"});
}

TEST_F(SceneJson, MaterialErrors) {
  expect_bad(ErrorCode::bad_material, paint({{"alpha", 0.0009}}), {"/materials/paint/alpha", "0.001 to 1"});
  expect_bad(ErrorCode::bad_material, paint({{"alpha", 1.01}}), {"/materials/paint/alpha"});
  expect_bad(ErrorCode::bad_material, paint({{"roughness", 0.03}}), {"/materials/paint/roughness"});
  expect_bad(ErrorCode::bad_material, paint({{"phong_exponent", 65536}}),
             {"/materials/paint/phong_exponent", "65535"});
  expect_bad(ErrorCode::bad_material, paint({{"phong_exponent", 10}, {"ndf", "ggx"}}), {"phong"});
  expect_bad(ErrorCode::bad_material, paint({{"alpha", 0.1}, {"roughness", 0.1}}),
             {"/materials/paint", "one of"});
  expect_bad(ErrorCode::json_out_of_range, paint({{"ndf", "blinn"}}), {"/materials/paint/ndf", "beckmann"});
  expect_bad(ErrorCode::json_out_of_range, paint({{"diffuse", 1.1}}), {"/materials/paint/diffuse"});
  expect_bad(ErrorCode::json_out_of_range, paint({{"specular", {0, -0.1, 0}}}),
             {"/materials/paint/specular/1"});
  expect_bad(ErrorCode::json_unknown_key, paint({{"rougness", 0.1}}), {"roughness"});
  expect_bad(ErrorCode::json_unknown_key, {{"materials", {{"piant", {{"alpha", 0.1}}}}}},
             {"/materials/piant", "did you mean \"paint\""});
  expect_bad(ErrorCode::json_unknown_key, mesh({{"material", "painte"}}),
             {"/meshes/0/material", "did you mean \"paint\""});
  // A mirror from a glTF file, which no microfacet lobe can be.
  Json gltf = triangle_gltf(folder);
  gltf["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0;
  folder.write_json("mesh.gltf", gltf);
  expect_error(ErrorCode::bad_material, {"mesh.gltf", "\"paint\"", "alpha"},
               [&] { folder.load(Json::object()); });
  EXPECT_NO_THROW(folder.load(paint({{"specular", 0}})));  // no lobe
  EXPECT_NO_THROW(folder.load(paint({{"alpha", 0.001}})));
  expect_error(ErrorCode::bad_material, {"0.005524"}, [&] {
    folder.load(paint({{"alpha", 0.005}, {"ndf", "phong"}}));
  });
}

TEST_F(SceneJson, Lights) {
  const auto load_light = [&](const Json& changes) { return folder.load(light(changes)).lights.at(0); };
  auto l = load_light({{"inner_cone_deg", 30}, {"radiant_intensity_w_sr", {1, 2, 3}}});
  EXPECT_EQ(l.name, "lamp");
  EXPECT_EQ(l.type, LightType::spot);
  EXPECT_EQ(l.position, (Vec3{0, 5, 0}));
  expect_near(l.forward, {0, -1, 0}, 0);
  expect_near(l.up, {0, 0, -1}, 0);
  EXPECT_EQ(l.intensity, (Vec3{1, 2, 3}));
  EXPECT_EQ(l.cos_inner, l.cos_outer);
  EXPECT_DOUBLE_EQ(l.extent_y, std::tan(std::numbers::pi / 6));
  EXPECT_NEAR(dot(cross(l.right, l.up), -l.forward), 1, 1e-12);  // right-handed, looking along -z

  l = load_light({{"target", nullptr}, {"direction", {0, 0, 9}}, {"up", {1, 1, 1}}, {"name", nullptr}});
  EXPECT_EQ(l.name, "light0");
  EXPECT_EQ(l.cos_inner, 1);  // a soft edge from the axis on
  expect_near(l.forward, {0, 0, 1}, 0);
  expect_near(l.up, {std::sqrt(0.5), std::sqrt(0.5), 0}, 1e-12);

  const Json point{{"type", "point"}, {"target", nullptr}, {"outer_cone_deg", nullptr}};
  EXPECT_EQ(load_light(point).type, LightType::point);
  const Json sun{{"type", "directional"},
                 {"position", nullptr},
                 {"target", nullptr},
                 {"direction", {0, -1, 0}},
                 {"radiant_intensity_w_sr", nullptr},
                 {"outer_cone_deg", nullptr},
                 {"irradiance_w_m2", 3}};
  l = load_light(sun);
  EXPECT_EQ(l.intensity, (Vec3{3, 3, 3}));
  EXPECT_EQ(l.position, Vec3{});
  EXPECT_EQ(l.extent_x, 1);  // the scene's radius

  Json two = light(Json::object());
  two["lights"].push_back(Json(two["lights"][0]));
  EXPECT_EQ(folder.load(two).lights.at(1).name, "lamp-2");
}

TEST_F(SceneJson, LightErrors) {
  expect_bad(ErrorCode::bad_light, light({{"direction", {0, 1, 0}}}), {"/lights/0", "either"});
  expect_bad(ErrorCode::bad_light, light({{"target", nullptr}}), {"/lights/0", "either"});
  expect_bad(ErrorCode::bad_light, light({{"target", {0, 5, 0}}}), {"/lights/0", "zero"});
  expect_bad(ErrorCode::bad_light, light({{"up", {0, 2, 0}}}), {"/lights/0", "parallel"});
  expect_bad(ErrorCode::bad_light, light({{"radiant_intensity_w_sr", 0}}), {"no light"});
  expect_bad(ErrorCode::bad_light, {{"lights", Json::array()}}, {"no light"});
  expect_bad(ErrorCode::json_out_of_range, light({{"outer_cone_deg", 90}}), {"/lights/0/outer_cone_deg"});
  expect_bad(ErrorCode::json_out_of_range, light({{"inner_cone_deg", 31}}), {"/lights/0/inner_cone_deg"});
  expect_bad(ErrorCode::json_out_of_range, light({{"radiant_intensity_w_sr", -1}}),
             {"/lights/0/radiant_intensity_w_sr"});
  expect_bad(ErrorCode::json_out_of_range, light({{"type", "area"}}), {"/lights/0/type", "directional"});
  expect_bad(ErrorCode::json_missing_key, light({{"outer_cone_deg", nullptr}}), {"outer_cone_deg"});
  expect_bad(ErrorCode::json_missing_key, light({{"position", nullptr}}), {"position"});
  expect_bad(ErrorCode::json_unknown_key, light({{"irradiance_w_m2", 1}}), {"irradiance_w_m2"});
  expect_bad(ErrorCode::json_unknown_key, light({{"type", "point"}}), {"/lights/0"});  // has no target
}

TEST_F(SceneJson, CameraAndAnchor) {
  const Scene scene = folder.load({{"anchor", {1, 2, 3}}, {"resolution", {300, 100}}});
  EXPECT_EQ(scene.anchor, (Vec3{1, 2, 3}));
  EXPECT_EQ(scene.camera.position, (Vec3{-1, -2, 2}));
  expect_near(scene.camera.forward, {0, 0, -1}, 0);
  expect_near(scene.camera.up, {0, 1, 0}, 0);
  expect_near(scene.camera.right, {1, 0, 0}, 0);
  EXPECT_DOUBLE_EQ(scene.camera.tan_x, 3 * std::tan(20 * std::numbers::pi / 180));
  EXPECT_EQ(folder.load(Json::object()).camera.width, 640);
  expect_near(folder.load({{"camera", {{"up", {1, 0, 0}}}}}).camera.up, {1, 0, 0}, 0);

  const auto camera = [](const Json& changes) { return Json{{"camera", changes}}; };
  expect_bad(ErrorCode::bad_camera, camera({{"target", {0, 0, 5}}}), {"/camera", "coincide"});
  expect_bad(ErrorCode::bad_camera, camera({{"up", {0, 0, 1}}}), {"/camera", "parallel"});
  expect_bad(ErrorCode::json_out_of_range, camera({{"vertical_fov_deg", 180}}), {"/camera/vertical_fov_deg"});
  expect_bad(ErrorCode::json_missing_key, camera({{"target", nullptr}}), {"target"});
  expect_bad(ErrorCode::json_unknown_key, camera({{"gltf_name", "view"}}), {"/camera"});
}

TEST_F(SceneJson, TexturesCanBeSetAndTakenAway) {
  folder.write("four.ppm", std::string("P6\n2 2\n255\n", 11) + std::string(12, '\x40'));
  Json changes = paint({{"base_color_texture", "four.ppm"},
                        {"metallic_roughness_texture", "four.ppm"},
                        {"normal_texture", "four.ppm"}});
  const Scene scene = folder.load(changes);
  const auto& material = scene.materials[0];
  ASSERT_EQ(scene.textures.size(), 2u);  // once as colour, once as numbers
  EXPECT_TRUE(scene.textures[material.base_color_texture].srgb);
  EXPECT_FALSE(scene.textures[material.normal_texture].srgb);
  EXPECT_EQ(material.metallic_roughness_texture, material.normal_texture);
  EXPECT_EQ(scene::scene_files(folder / "scene.json").back().filename(), "four.ppm");

  Json gltf = triangle_gltf(folder);
  gltf["materials"][0]["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
  gltf["textures"] = {{{"source", 0}}};
  gltf["images"] = {{{"uri", "four.ppm"}}};
  folder.write_json("mesh.gltf", gltf);
  EXPECT_EQ(folder.load(Json::object()).materials[0].normal_texture, 0);
  EXPECT_EQ(folder.load(Json::object()).materials[0].normal_scale, 0.5);
  Json without = SceneFolder::basic();  // merge_patch cannot carry a null
  without["materials"] = {{"paint", {{"normal_texture", nullptr}}}};
  EXPECT_EQ(scene::load_scene(folder.write_json("scene.json", without)).materials[0].normal_texture, -1);

  expect_error(ErrorCode::texture_unreadable, {"gone.png", "missing"}, [&] {
    folder.load(paint({{"base_color_texture", "gone.png"}}));
  });
  folder.write("broken.png", std::string("not a picture"));
  expect_error(ErrorCode::texture_unreadable, {"broken.png"}, [&] {
    folder.load(paint({{"base_color_texture", "broken.png"}}));
  });
}

// The committed schema and the reader must know the same keys: scenes that use every one of them load, and
// use no other.
TEST_F(SceneJson, SchemaNamesTheSameKeys) {
  std::ifstream file(std::filesystem::path(VSGL_SOURCE_DIR) / "configs/schema/scene.schema.json");
  const Json schema = Json::parse(file);
  const Json& parts = schema.at("$defs");
  const auto keys = [](const Json& object) {
    std::set<std::string> out;
    for (const auto& [key, value] : object.items()) out.insert(key);
    return out;
  };
  folder.write("four.ppm", std::string("P6\n1 1\n255\n", 11) + "abc");
  const Json transform{{"translation", {0, 0, 0}}, {"rotation_deg", {0, 0, 0}}, {"scale", 1}};
  const Json quaternion{{"quaternion", {0, 0, 0, 1}}},
      matrix{{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
  const Json material{{"diffuse", 0.5},
                      {"specular", 0.1},
                      {"alpha", 0.1},
                      {"ndf", "ggx"},
                      {"metallic", 0},
                      {"normal_scale", 1},
                      {"alpha_cutoff", 0},
                      {"base_color_texture", "four.ppm"},
                      {"metallic_roughness_texture", "four.ppm"},
                      {"normal_texture", "four.ppm"}};
  Json spot = SceneFolder::spot();
  spot.update({{"inner_cone_deg", 1}, {"up", {1, 0, 0}}});
  const Json sun{{"type", "directional"}, {"direction", {0, -1, 0}}, {"irradiance_w_m2", 1}};
  Json full = SceneFolder::basic();
  full["meshes"][0].update({{"material", "paint"}, {"transform", {transform, quaternion, matrix}}});
  full["materials"] = {{"paint", material}, {"*", {{"roughness", 0.5}}}};
  full["lights"] = {spot, sun};
  full["camera"]["up"] = {0, 1, 0};
  const Json key{{"frame", 0}, {"value", {0, 0, 5}}};
  const Json track{{"target", "/camera/position"}, {"interpolation", "step"}, {"keys", Json::array({key})}};
  const Json animation{{"frame_rate_hz", 30}, {"frames", 2}, {"tracks", Json::array({track})}};
  full.update({{"anchor", {0, 0, 0}}, {"resolution", {8, 8}}, {"lumens_per_watt", 683}});
  full["animation"] = animation;
  const Json sphere{{"name", "bulb"}, {"position", {0, 1, 0}}, {"radius_m", 0.1}, {"radiance_w_m2_sr", 1}};
  full["sphere_lights"] = Json::array({sphere});
  full["environment"] = {{"file", "map.exr"}, {"rotation_deg", {0, 0, 0}}, {"scale", 1}};
  ASSERT_NO_THROW(scene::load_scene(folder.write_json("scene.json", full)));

  const auto together = [&](std::initializer_list<Json> objects, std::set<std::string> more = {}) {
    for (const Json& object : objects) more.merge(keys(object));
    return more;
  };
  EXPECT_EQ(keys(schema.at("properties")), keys(full));
  EXPECT_EQ(keys(parts.at("mesh").at("properties")), keys(full["meshes"][0]));
  EXPECT_EQ(keys(parts.at("transform").at("properties")), together({transform, quaternion, matrix}));
  EXPECT_EQ(keys(parts.at("material").at("properties")),
            together({material}, {"roughness", "phong_exponent"}));
  EXPECT_EQ(keys(parts.at("light").at("properties")), together({spot, sun}));
  EXPECT_EQ(keys(parts.at("sphere_light").at("properties")), keys(sphere));
  EXPECT_EQ(keys(parts.at("camera").at("properties")), together({full["camera"]}, {"gltf_name"}));
  EXPECT_EQ(keys(parts.at("environment").at("properties")), keys(full["environment"]));
  EXPECT_EQ(keys(parts.at("animation").at("properties")), keys(animation));
  EXPECT_EQ(keys(parts.at("track").at("properties")), keys(track));
  EXPECT_EQ(keys(parts.at("key").at("properties")), keys(key));
  for (const auto& part :
       {schema, parts.at("mesh"), parts.at("transform"), parts.at("material"), parts.at("light"),
        parts.at("camera"), parts.at("sphere_light"), parts.at("environment"), parts.at("animation"),
        parts.at("track"), parts.at("key")}) {
    EXPECT_EQ(part.at("additionalProperties"), false);
  }
}

TEST_F(SceneJson, CommittedScenesLoad) {
  const std::filesystem::path scenes = std::filesystem::path(VSGL_SOURCE_DIR) / "configs/scenes";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    SCOPED_TRACE(entry.path());
    ++count;
    ASSERT_TRUE(std::filesystem::exists("/usr/share/glmark2/models")) << "install glmark2-data (make setup)";
    const Scene scene = scene::load_scene(entry.path());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.triangle_count(), 69666u);
  }
  EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace vsgl::test
