#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/strict_json.h"
#include "scene/scene.h"

namespace vsgl::scene {

inline constexpr double min_alpha = 1e-3;  // interop::ALPHA_MIN, not rounded to single precision

// What a scene JSON says, before any mesh is read; everything in world coordinates.

// A texture that an override sets; no path: takes the material's texture away.
struct TextureOverride {
  std::optional<std::filesystem::path> file;
};

struct MaterialOverride {
  std::string name;   // of the material, or "*" for all
  std::string where;  // file and JSON pointer, for messages
  std::optional<Vec3> diffuse, specular;
  std::optional<double> alpha, metallic, normal_scale, alpha_cutoff;
  std::optional<std::uint32_t> ndf;
  std::optional<TextureOverride> base_color_texture, metallic_roughness_texture, normal_texture;
};

struct MeshSpec {
  std::filesystem::path file;
  std::vector<Mat4> transforms;         // outermost first
  std::optional<std::string> material;  // replaces all of the file's
  std::string where;
};

struct SceneSpec {
  std::vector<MeshSpec> meshes;
  std::vector<MaterialOverride> materials;  // "*" first
  std::optional<std::vector<LightSource>> lights;
  std::vector<SphereLight> sphere_lights;
  std::optional<EnvironmentSpec> environment;
  std::optional<Camera> camera;  // tan_x still unset
  std::optional<std::string> gltf_camera;
  std::optional<Vec3> anchor;
  double lumens_per_watt = 683;
  int width = 640, height = 360;
};

// From a scene JSON whose relative paths start at `folder`; its animation is not looked at. Throws json_*,
// wrong_schema, bad_material, bad_camera and bad_light.
SceneSpec read_scene_spec(const JsonValue& root, const std::filesystem::path& folder);

// Completes an orthonormal frame about `forward` with an `up` near the given one. Returns false where they
// are degenerate or parallel.
bool make_frame(Vec3 forward, Vec3 up, Vec3& right_out, Vec3& up_out, Vec3& forward_out);

}  // namespace vsgl::scene
