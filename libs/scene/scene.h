#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "math/light_source.h"
#include "math/vec.h"
#include "scene/environment.h"
#include "scene/sphere_light.h"

namespace vsgl::scene {

// 8-bit RGBA, row 0 at the top (v = 0), as texture coordinates of glTF count.
struct Texture {
  std::string name;
  int width = 0, height = 0;
  bool srgb = false;
  std::vector<std::uint8_t> rgba;

  // Throws texture_unreadable unless it has at least one texel, and bytes for all.
  void require_whole() const;
  bool operator==(const Texture&) const = default;
};

// Lambert diffuse + one microfacet lobe, from glTF's metallic-roughness model:
//   base = base_color * texture;  metal = metallic * texture.b;  alpha = this alpha * texture.g^2
//   diffuse reflectance = base (1 - metal);  specular reflectance = mix(specular, base, metal)
// A surface whose specular reflectance is 0 has no specular lobe. Reflectances 0..1, no Fresnel.
struct Material {
  std::string name;
  Vec3 base_color{0.8, 0.8, 0.8};
  double metallic = 0;
  Vec3 specular{0.04, 0.04, 0.04};  // of the dielectric part
  double alpha = 1;                 // roughness, 1e-3..1; Phong exponent n is kept as sqrt(2/(n+2))
  std::uint32_t ndf = 1;            // interop::NDF_GGX, NDF_BECKMANN, NDF_PHONG
  double alpha_cutoff = 0;          // base-colour alpha below this is a hole; 0: opaque
  double normal_scale = 1;
  int base_color_texture = -1, metallic_roughness_texture = -1,
      normal_texture = -1;  // index into Scene::textures

  bool operator==(const Material&) const = default;
};

struct Vertex {
  std::array<float, 3> position;  // m, relative to the anchor
  std::array<float, 3> normal;    // unit
  std::array<float, 4> tangent;   // unit, w = handedness (+1 or -1); bitangent = w cross(normal, tangent)
  std::array<float, 2> uv;

  bool operator==(const Vertex&) const = default;
};

// One mesh instance in world orientation (transforms composed in double, then subtracted from the anchor).
struct Instance {
  std::string name;
  int material = 0;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t>
      indices;  // triangles; counter-clockwise fronts, mirrored transforms already flipped

  bool operator==(const Instance&) const = default;
};

struct Camera {
  Vec3 position;  // relative to the anchor
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  double tan_x = 1, tan_y = 1;  // of the half angles
  int width = 640, height = 360;
};

struct Scene {
  Vec3 anchor;                      // world, m
  double radius = 1;                // of a sphere about the anchor that holds all vertices
  std::vector<Instance> instances;  // the index is the `id.I` of the artifacts
  std::vector<Material> materials;
  std::vector<Texture> textures;
  Camera camera;
  // One per light of the scene (none where it has an environment alone), in world orientation, positions relative to the anchor. A point light's axes
  // are the world's; a directional light's position is the anchor (the RSM stage frames both).
  std::vector<LightSource> lights;
  std::optional<EnvironmentSpec> environment;  // read by those who light the scene with it
  std::vector<SphereLight> sphere_lights;      // relative to the anchor
  std::vector<std::string> warnings;  // blended materials taken as cut-outs, and the like

  std::size_t triangle_count() const;
};

// Reads a scene JSON (configs/schema/scene.schema.json) and everything it refers to; paths are relative to
// the JSON's folder; several frames of one animation are cheaper with SceneSequence. Throws json_*, mesh_*,
// texture_unreadable, bad_material, bad_camera, bad_light, file_not_found, and out_of_range for a frame that
// the scene does not have (without animation all but 0).
Scene load_scene(const std::filesystem::path& json_path, int frame = 0);

// All files that load_scene() reads, for provenance: the JSON first.
std::vector<std::filesystem::path> scene_files(const std::filesystem::path& json_path);

}  // namespace vsgl::scene
