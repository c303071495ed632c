#include "scene/scene_spec.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/strict_json.h"
#include "interop/model.h"
#include "scene/sphere_light.h"
#include "scene/transform.h"

namespace vsgl::scene {
namespace {

namespace fs = std::filesystem;

constexpr double degree = std::numbers::pi / 180;
constexpr double max_phong_exponent = 65535;

Vec3 read_vec3(const JsonValue& value) {
  return to_vec3(value.numbers<3>());
}

// A number for grey, or red, green and blue.
Vec3 read_colour(const JsonValue& value, double maximum) {
  if (value.raw().is_array()) return to_vec3(value.numbers<3>(0, maximum));
  const double grey = value.number(0, maximum);
  return {grey, grey, grey};
}

void read_if(const JsonValue& object, const std::string& key, double minimum, double maximum,
             std::optional<double>& out) {
  if (const auto value = object.find(key)) out = value->number(minimum, maximum);
}

// Meshes

Mat4 read_matrix(const JsonValue& value) {
  const auto numbers = value.numbers<16>();
  Mat4 out;
  for (int i = 0; i < 16; ++i) out.m[i / 4][i % 4] = numbers[i];
  if (out.m[3][0] != 0 || out.m[3][1] != 0 || out.m[3][2] != 0 || out.m[3][3] != 1) {
    throw Error(ErrorCode::json_out_of_range,
                value.where() + ": the last row of the row-major matrix must be 0 0 0 1");
  }
  return out;
}

Mat4 read_rotation(const JsonValue& object) {
  const auto angles = object.find("rotation_deg"), quaternion = object.find("quaternion");
  if (angles && quaternion) {
    throw Error(ErrorCode::json_out_of_range, object.where() + ": give either rotation_deg or quaternion");
  }
  if (angles) return rotation_xyz_deg(read_vec3(*angles));
  if (!quaternion) return {};
  auto q = quaternion->numbers<4>();
  const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!(norm > 1e-9))
    throw Error(ErrorCode::json_out_of_range, quaternion->where() + ": a zero quaternion is no rotation");
  for (double& component : q) component /= norm;
  return rotation(q);
}

Mat4 read_transform(const JsonValue& object) {
  Mat4 out;
  if (const auto value = object.find("matrix")) {
    out = read_matrix(*value);
  } else {
    if (const auto offset = object.find("translation")) out = translation(read_vec3(*offset));
    out = out * read_rotation(object);
    if (const auto scale = object.find("scale")) {
      const Vec3 factors = scale->raw().is_array() ? read_vec3(*scale) : Vec3{1, 1, 1} * scale->number();
      out = out * scaling(factors);
    }
  }
  object.finish();
  if (determinant(out) == 0)
    throw Error(ErrorCode::json_out_of_range, object.where() + ": the transform flattens space");
  return out;
}

MeshSpec read_mesh(const JsonValue& object, const fs::path& folder) {
  MeshSpec mesh;
  mesh.where = object.where();
  mesh.file = (folder / object.at("file").string()).lexically_normal();
  if (const auto transform = object.find("transform")) {
    if (transform->raw().is_array()) {
      for (const JsonValue& step : transform->array(1)) mesh.transforms.push_back(read_transform(step));
    } else {
      mesh.transforms.push_back(read_transform(*transform));
    }
  }
  if (const auto material = object.find("material")) mesh.material = material->string();
  object.finish();
  return mesh;
}

// Materials

std::optional<TextureOverride> read_texture_override(const JsonValue& object, const std::string& key,
                                                     const fs::path& folder) {
  const auto value = object.find(key);
  if (!value) return std::nullopt;
  if (value->raw().is_null()) return TextureOverride{};
  return TextureOverride{(folder / value->string()).lexically_normal()};
}

[[noreturn]] void bad_material(const JsonValue& value, const std::string& what) {
  throw Error(ErrorCode::bad_material, value.where() + ": " + what);
}

double read_alpha(const JsonValue& value, double alpha) {
  if (!(alpha >= min_alpha && alpha <= 1)) {
    bad_material(value,
                 "the lobe's alpha would be " + std::to_string(alpha) + "; it must be from 0.001 to 1");
  }
  return alpha;
}

// The one of alpha, roughness (alpha = roughness^2) and phong_exponent (alpha = sqrt(2 / (n + 2))) that is
// given.
void read_lobe(const JsonValue& object, MaterialOverride& out) {
  if (const auto ndf = object.find("ndf")) {
    const std::string name = ndf->choice({"ggx", "beckmann", "phong"});
    out.ndf = name == "ggx"        ? interop::NDF_GGX
              : name == "beckmann" ? interop::NDF_BECKMANN
                                   : interop::NDF_PHONG;
  }
  const auto alpha = object.find("alpha"), roughness = object.find("roughness"),
             exponent = object.find("phong_exponent");
  if (int{alpha.has_value()} + int{roughness.has_value()} + int{exponent.has_value()} > 1) {
    bad_material(object, "give one of alpha, roughness and phong_exponent");
  }
  if (alpha) out.alpha = read_alpha(*alpha, alpha->number());
  if (roughness) out.alpha = read_alpha(*roughness, roughness->number() * roughness->number());
  if (exponent) {
    const double n = exponent->number();
    if (!(n >= 0 && n <= max_phong_exponent)) bad_material(*exponent, "the exponent must be from 0 to 65535");
    if (out.ndf && *out.ndf != interop::NDF_PHONG)
      bad_material(*exponent, "a Phong exponent goes with ndf \"phong\" only");
    out.ndf = interop::NDF_PHONG;
    out.alpha = std::sqrt(2 / (n + 2));
  }
}

MaterialOverride read_material(const std::string& name, const JsonValue& object, const fs::path& folder) {
  MaterialOverride out;
  out.name = name;
  out.where = object.where();
  if (const auto value = object.find("diffuse")) out.diffuse = read_colour(*value, 1);
  if (const auto value = object.find("specular")) out.specular = read_colour(*value, 1);
  read_lobe(object, out);
  read_if(object, "metallic", 0, 1, out.metallic);
  read_if(object, "normal_scale", 0, 100, out.normal_scale);
  read_if(object, "alpha_cutoff", 0, 1, out.alpha_cutoff);
  out.base_color_texture = read_texture_override(object, "base_color_texture", folder);
  out.metallic_roughness_texture = read_texture_override(object, "metallic_roughness_texture", folder);
  out.normal_texture = read_texture_override(object, "normal_texture", folder);
  object.finish();
  return out;
}

// Lights and camera

// Any up that is not along `forward`, preferably +y.
Vec3 default_up(Vec3 forward) {
  return std::abs(forward.y) > 0.999 * length(forward) ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
}

void aim(const JsonValue& object, LightSource& light) {
  const auto direction = object.find("direction"), target = object.find("target");
  if (direction.has_value() == target.has_value()) {
    throw Error(ErrorCode::bad_light, object.where() + ": give either direction or target");
  }
  const Vec3 forward = direction ? read_vec3(*direction) : read_vec3(*target) - light.position;
  const auto up = object.find("up");
  if (!make_frame(forward, up ? read_vec3(*up) : default_up(forward), light.right, light.up, light.forward)) {
    throw Error(ErrorCode::bad_light, object.where() + ": the direction is zero or parallel to up");
  }
}

void read_cone(const JsonValue& object, LightSource& light) {
  const double outer = object.at("outer_cone_deg").number(0.01, 89);
  const auto inner_value = object.find("inner_cone_deg");
  const double inner = inner_value ? inner_value->number(0, outer) : 0;
  light.cos_inner = std::cos(inner * degree);
  light.cos_outer = std::cos(outer * degree);
  light.extent_x = light.extent_y = std::tan(outer * degree);
}

LightSource read_light(const JsonValue& object, std::size_t index) {
  LightSource light;
  const auto name = object.find("name");
  light.name = name ? name->string() : "light" + std::to_string(index);
  const std::string type = object.at("type").choice({"spot", "directional", "point"});
  light.type = type == "spot" ? LightType::spot : type == "point" ? LightType::point : LightType::directional;
  const bool directional = light.type == LightType::directional;
  light.intensity = read_colour(object.at(directional ? "irradiance_w_m2" : "radiant_intensity_w_sr"), 1e30);
  if (!directional) {
    light.position = read_vec3(object.at("position"));
  } else if (const auto position = object.find("position")) {
    light.position = read_vec3(*position);  // only gives `target` a meaning
  }
  if (light.type != LightType::point) aim(object, light);
  if (light.type == LightType::spot) read_cone(object, light);
  object.finish();
  return light;
}

EnvironmentSpec read_environment_spec(const JsonValue& object, const fs::path& folder) {
  EnvironmentSpec out;
  out.file = (folder / object.at("file").string()).lexically_normal();
  if (const auto rotation = object.find("rotation_deg")) out.rotation_deg = read_vec3(*rotation);
  if (const auto scale = object.find("scale")) out.scale = scale->number(0, 1e30);
  object.finish();
  return out;
}

void read_camera(const JsonValue& object, SceneSpec& spec) {
  if (const auto name = object.find("gltf_name")) {
    spec.gltf_camera = name->string();
  } else {
    Camera camera;
    camera.position = read_vec3(object.at("position"));
    const Vec3 forward = read_vec3(object.at("target")) - camera.position;
    const auto up = object.find("up");
    if (!make_frame(forward, up ? read_vec3(*up) : default_up(forward), camera.right, camera.up,
                    camera.forward)) {
      throw Error(ErrorCode::bad_camera,
                  object.where() + ": position and target coincide, or up is parallel to the view");
    }
    camera.tan_y = std::tan(object.at("vertical_fov_deg").number(0.01, 179) * degree / 2);
    spec.camera = camera;
  }
  object.finish();
}

void read_resolution(const JsonValue& value, SceneSpec& spec) {
  const auto sides = value.array(2, 2);
  spec.width = static_cast<int>(sides[0].integer(1, 16384));
  spec.height = static_cast<int>(sides[1].integer(1, 16384));
}

void check_schema(const JsonValue& root) {
  const JsonValue schema = root.at("$schema");
  if (schema.string() != "vsgltools/scene/1") {
    throw Error(ErrorCode::wrong_schema,
                schema.where() + ": expected \"vsgltools/scene/1\", got \"" + schema.string() + "\"");
  }
}

}  // namespace

bool make_frame(Vec3 forward, Vec3 up, Vec3& right_out, Vec3& up_out, Vec3& forward_out) {
  forward_out = normalise(forward);
  const Vec3 right = cross(forward_out, normalise(up));
  if (!(length(right) > 1e-6)) return false;
  right_out = normalise(right);
  up_out = cross(right_out, forward_out);
  return true;
}

SceneSpec read_scene_spec(const JsonValue& root, const fs::path& folder) {
  check_schema(root);
  SceneSpec spec;
  for (const JsonValue& mesh : root.at("meshes").array(1)) spec.meshes.push_back(read_mesh(mesh, folder));
  if (const auto materials = root.find("materials")) {
    for (const std::string& name : materials->keys()) {
      spec.materials.push_back(read_material(name, materials->at(name), folder));
    }
    std::stable_partition(spec.materials.begin(), spec.materials.end(),
                          [](const auto& m) { return m.name == "*"; });
  }
  if (const auto lights = root.find("lights")) {
    spec.lights.emplace();
    for (const JsonValue& light : lights->array())
      spec.lights->push_back(read_light(light, spec.lights->size()));
  }
  if (const auto environment = root.find("environment"))
    spec.environment = read_environment_spec(*environment, folder);
  if (const auto camera = root.find("camera")) read_camera(*camera, spec);
  if (const auto resolution = root.find("resolution")) read_resolution(*resolution, spec);
  if (const auto anchor = root.find("anchor")) spec.anchor = read_vec3(*anchor);
  if (const auto efficacy = root.find("lumens_per_watt")) spec.lumens_per_watt = efficacy->number(1e-3, 1e6);
  spec.sphere_lights = read_sphere_lights(root);
  root.find("animation");  // a key that is known: class Animation reads it
  root.finish();
  return spec;
}

}  // namespace vsgl::scene
