#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/strict_json.h"
#include "scene/mesh_file.h"
#include "scene/procedural/animate.h"
#include "scene/procedural/generators.h"
#include "scene/procedural/glb.h"

namespace vsgl::scene {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Generator {
  GeneratorInfo info;
  std::function<Model(const GenerateOptions&)> make;
};

const std::vector<Generator>& registry() {
  static const std::vector<Generator> all{
      {{"cornell",
        "the Cornell box by its published measurements, all diffuse; --mesh puts a mesh in place of the "
        "blocks"},
       make_cornell},
      {{"cornell-glossy", "the same with a glossy floor and tall block"}, make_cornell_glossy},
      {{"caustic-ring", "a metal half ring on a diffuse floor, lit from its open side"}, make_caustic_ring},
      {{"atrium", "a colonnade with arches round a court, textured and normal-mapped floor and walls"},
       make_atrium},
      {{"thin-walls", "a room divided by a wall without thickness and one of 1 cm, lit at one end"},
       make_thin_walls},
      {{"sky", "metal balls from smooth to rough and a block under a sky, with its environment map"},
       make_sky},
      {{"sphere-light", "a glossy plane under a small sphere light, seen at a grazing angle"},
       make_sphere_light},
      {{"figure", "a jointed figure on a floor under a soft sky, with its environment map"}, make_figure},
  };
  return all;
}

const Generator& find(const std::string& name) {
  std::vector<std::string> names;
  for (const Generator& generator : registry()) {
    if (generator.info.name == name) return generator;
    names.push_back(generator.info.name);
  }
  std::string choices;
  for (const std::string& choice : names) choices += (choices.empty() ? "" : ", ") + choice;
  throw Error(ErrorCode::bad_value, "\"" + name + "\" is no scene; choose one of " + choices);
}

void check(const std::string& name, const GenerateOptions& options) {
  const auto fail = [](const std::string& what) { throw Error(ErrorCode::out_of_range, what); };
  const Vec3 o = options.offset;
  if (!(std::isfinite(o.x) && std::isfinite(o.y) && std::isfinite(o.z))) fail("--offset: not finite");
  if (!(options.scale >= 1e-6 && options.scale <= 1e6)) fail("--scale: must be from 1e-6 to 1e6");
  if (options.alpha && !(*options.alpha >= 1e-3 && *options.alpha <= 1))
    fail("--alpha: must be from 0.001 to 1");
  if (options.exponent && !(*options.exponent >= 0 && *options.exponent <= 65535)) {
    fail("--exponent: must be from 0 to 65535");
  }
  if (options.alpha && options.exponent) {
    throw Error(ErrorCode::conflicting_options, "--alpha and --exponent: give one of them");
  }
  if (options.exponent && options.ndf != "ggx" && options.ndf != "phong") {
    throw Error(ErrorCode::conflicting_options,
                "--exponent: a Phong exponent does not go with --ndf " + options.ndf);
  }
  if (!options.texture_dir.empty() && name != "atrium") {
    throw Error(ErrorCode::conflicting_options, "--texture-dir: only the scene \"atrium\" has textures");
  }
  if (options.frames && options.animate == "none") {
    throw Error(ErrorCode::conflicting_options, "--frames: only an animated scene has some; give --animate");
  }
  if (options.frames && !(*options.frames >= 2 && *options.frames <= 10000)) {
    fail("--frames: must be from 2 to 10000");
  }
  if (!options.mesh.empty() && name != "cornell") {
    throw Error(ErrorCode::conflicting_options, "--mesh: only the scene \"cornell\" takes one");
  }
}

Json array_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

// As the user stated it: a Phong exponent, or alpha.
Json lobe_json(const GenerateOptions& options, double alpha, const std::string& ndf) {
  if (options.exponent) return {{"phong_exponent", *options.exponent}, {"ndf", ndf}};
  return {{"alpha", alpha}, {"ndf", ndf}};
}

// What glTF cannot say, or not exactly: the normal distribution and the reflectance of a lobe.
Json material_json(const GenerateOptions& options, const ModelMaterial& material) {
  Json out = material.metal ? Json{{"diffuse", array_of(material.base_color)}, {"metallic", 1}}
                            : Json{{"specular", array_of(material.specular)}};
  out.update(lobe_json(options, material.alpha, material.ndf));
  return out;
}

// A mesh in the box

// Makes the mesh stand on the box's floor: its bottom centre there, turned towards the camera, at most 0.33 m
// in any direction.
Json mesh_transforms(const GenerateOptions& options) {
  TexturePool textures;
  const MeshFile file = load_mesh_file(options.mesh, false, textures);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  std::vector<Mat4> world;
  for (const MeshNode& node : file.nodes) {
    world.push_back(node.parent < 0 ? node.local : world[node.parent] * node.local);
    for (const int mesh : node.meshes)
      for (const Vertex& vertex : file.meshes[mesh].vertices) {
        const auto& p = vertex.position;
        const auto point = to_array(world.back().point(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])}));
        for (int i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], point[i]);
          high[i] = std::max(high[i], point[i]);
        }
      }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  if (!(extent > 0)) {
    throw Error(ErrorCode::mesh_invalid,
                options.mesh.string() + ": the mesh has no extent, or holds no triangles");
  }
  Json steps = Json::array();
  if (options.offset != Vec3{} || options.scale != 1) {
    steps.push_back({{"translation", array_of(options.offset)}, {"scale", options.scale}});
  }
  steps.push_back(
      {{"translation", {0.29, 0, 0.28}}, {"rotation_deg", {0, 160, 0}}, {"scale", 0.33 / extent}});
  steps.push_back({{"translation", {0.5 * (-low[0] - high[0]), -low[1], 0.5 * (-low[2] - high[2])}}});
  return steps;
}

Json mesh_material(const GenerateOptions& options) {
  const auto [alpha, ndf] = chosen_lobe(options, 0.2);
  Json out;
  if (options.mesh_material == "diffuse") return {{"diffuse", 0.75}, {"specular", 0}};
  if (options.mesh_material == "glossy") {
    out = {{"diffuse", 0.4}, {"specular", 0.4}};
  } else if (options.mesh_material == "metal") {
    out = {{"diffuse", {0.95, 0.79, 0.45}}, {"metallic", 1}};
  } else {
    throw Error(ErrorCode::bad_value,
                "--mesh-material: \"" + options.mesh_material + "\" is not one of diffuse, glossy, metal");
  }
  out.update(lobe_json(options, alpha, ndf));
  return out;
}

// As the scene JSON refers to it: absolute paths stay, others become relative to the JSON's folder.
std::string reference(const fs::path& file, const fs::path& folder) {
  if (file.is_absolute()) return file.string();
  return fs::absolute(file)
      .lexically_relative(fs::absolute(folder).lexically_normal())
      .lexically_normal()
      .string();
}

// The pictures of glmark2 that suit the atrium.
std::vector<fs::path> glmark2_textures(const fs::path& folder) {
  return {folder / "terrain-grasslight-512.jpg", folder / "terrain-grasslight-512-nm.jpg",
          folder / "crate-base.png"};
}

Json sphere_light(const ModelSphereLight& light, const GenerateOptions& options) {
  return {{"position", array_of(options.offset + options.scale * light.position)},
          {"radius_m", options.scale * light.radius},
          {"radiance_w_m2_sr", light.radiance_w_m2_sr}};
}

// The parts of a figure, each a chain of joints below the scene's own transform.
void add_parts(Json& out, const Model& model, const GenerateOptions& options) {
  for (const ModelPart& part : model.parts) {
    Json steps = Json::array({{{"translation", array_of(options.offset)}, {"scale", options.scale}}});
    for (const ModelJoint& joint : part.joints)
      steps.push_back(
          {{"translation", array_of(joint.position)}, {"rotation_deg", array_of(joint.rotation_deg)}});
    out["meshes"].push_back({{"file", part.file}, {"transform", steps}, {"material", part.material}});
  }
}

Json scene_json(const Model& model, const GenerateOptions& options, const fs::path& folder,
                const std::string& stem) {
  Json out{{"$schema", "vsgltools/scene/1"}};
  out["meshes"] = Json::array({{{"file", stem + ".glb"}}});
  Json materials = Json::object();
  for (const ModelMaterial& material : model.materials) {
    if (material.has_lobe()) materials[material.name] = material_json(options, material);
  }
  if (!options.mesh.empty()) {
    out["meshes"].push_back({{"file", reference(options.mesh, folder)},
                             {"transform", mesh_transforms(options)},
                             {"material", "mesh"}});
    materials["mesh"] = mesh_material(options);
  }
  if (!options.texture_dir.empty()) {
    const auto pictures = glmark2_textures(options.texture_dir);
    materials["floor"]["base_color_texture"] = reference(pictures[0], folder);
    materials["floor"]["normal_texture"] = reference(pictures[1], folder);
    materials["wall"]["base_color_texture"] = reference(pictures[2], folder);
    materials["wall"]["normal_texture"] =
        reference(pictures[1], folder);  // a fine grain that suits wood as well
  }
  for (const auto& [name, diffuse] : model.part_materials)
    materials[name] = {{"diffuse", array_of(diffuse)}, {"specular", 0}};
  add_parts(out, model, options);
  if (!materials.empty()) out["materials"] = materials;
  if (!model.environment.empty()) out["environment"] = {{"file", model.environment}};
  if (model.sphere_light.radius > 0)
    out["sphere_lights"] = Json::array({sphere_light(model.sphere_light, options)});
  out["camera"] = {{"gltf_name", "camera"}};
  out["resolution"] = {options.width.value_or(model.width), options.height.value_or(model.height)};
  return out;
}

}  // namespace

Lobe chosen_lobe(const GenerateOptions& options, double fallback) {
  if (options.exponent) return {std::sqrt(2 / (*options.exponent + 2)), "phong"};
  return {options.alpha.value_or(fallback), options.ndf};
}

const std::vector<GeneratorInfo>& generators() {
  static const std::vector<GeneratorInfo> all = [] {
    std::vector<GeneratorInfo> infos;
    for (const Generator& generator : registry()) infos.push_back(generator.info);
    return infos;
  }();
  return all;
}

GeneratedScene generate_scene(const std::string& name, const GenerateOptions& options, const fs::path& folder,
                              const std::string& stem) {
  const Generator& generator = find(name);
  check(name, options);
  Model model = generator.make(options);
  for (ModelImage& image : model.images) image.name = stem + "-" + image.name;
  for (ModelImage& file : model.part_files) file.name = stem + "-" + file.name;
  for (ModelPart& part : model.parts) part.file = stem + "-" + part.file;
  if (!model.environment.empty()) model.environment = stem + "-" + model.environment;
  for (ModelMaterial& material : model.materials)
    for (std::string* image : {&material.base_color_image, &material.normal_image})
      if (!image->empty()) *image = stem + "-" + *image;
  GeneratedScene out;
  out.triangles = model.triangle_count();
  Json scene = scene_json(model, options, folder, stem);
  const std::vector<GeneratedFile> moving = animate(scene, model, options, stem);
  out.files.push_back({stem + ".json", scene.dump(2) + "\n"});
  out.files.push_back({stem + ".glb", write_glb(model, options.offset, options.scale)});
  out.files.insert(out.files.end(), moving.begin(), moving.end());
  for (ModelImage& file : model.part_files)
    out.files.push_back({std::move(file.name), std::move(file.bytes)});
  for (ModelImage& image : model.images) out.files.push_back({std::move(image.name), std::move(image.bytes)});
  return out;
}

std::vector<fs::path> referenced_files(const GenerateOptions& options) {
  std::vector<fs::path> files;
  if (!options.texture_dir.empty()) files = glmark2_textures(options.texture_dir);
  if (!options.mesh.empty()) files.push_back(options.mesh);
  return files;
}

}  // namespace vsgl::scene
