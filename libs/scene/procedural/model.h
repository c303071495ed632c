#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/vec.h"

namespace vsgl::scene {

// Triangles of one material; as glTF stores them.
struct ModelMesh {
  std::string name;
  int material = 0;
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 2>> uvs;  // none: no texture coordinates
  std::vector<std::uint32_t> indices;
};

struct ModelNode {
  std::string name;
  int mesh = 0;
  Mat4 transform;
};

struct ModelMaterial {
  std::string name;
  Vec3 base_color{};  // diffuse reflectance, or of a metal the specular one
  Vec3 specular{};    // of a dielectric
  bool metal = false;
  double alpha = 1;  // roughness of the specular lobe
  std::string ndf = "ggx";
  std::string base_color_image{}, normal_image{};  // file names; empty: none
  bool has_lobe() const { return metal || specular != Vec3{}; }
};

struct ModelImage {
  std::string name;   // file name
  std::string bytes;  // PNG or OpenEXR
};

// A spot light or camera at `position`, looking at `target`.
struct ModelView {
  Vec3 position, target;
  double fov_deg = 40;  // camera: vertical, whole; light: half angle of the outer cone
};

// Of the same radiance in all directions.
struct ModelSphereLight {
  Vec3 position;
  double radius = 0;  // m; 0: none
  double radiance_w_m2_sr = 1;
};

// Where a part is joined to the one that it hangs on, and how it swings there: by so many degrees about x, a
// whole swing in a cycle that begins at `phase` (turns).
struct ModelJoint {
  Vec3 position, rotation_deg;
  double swing_deg = 0, phase = 0;
};

// A moving part of a figure: a mesh file of its own, which several may share.
struct ModelPart {
  std::string file;       // one of Model::part_files
  std::size_t triangles;  // of the file
  std::string material;
  std::vector<ModelJoint> joints;  // from the world to the part
};
struct ModelPartMaterial {
  std::string name;
  Vec3 diffuse;
};

// A scene before it is moved, scaled and written; metres, y up.
struct Model {
  std::vector<ModelMaterial> materials;
  std::vector<ModelMesh> meshes;
  std::vector<ModelNode> nodes;
  std::vector<ModelImage> images;
  std::vector<ModelImage> part_files;  // Wavefront OBJ
  std::vector<ModelPart> parts;
  std::vector<ModelPartMaterial> part_materials;
  std::string environment;  // which of the images lights the scene from far away; empty: none
  ModelView camera, light;
  ModelSphereLight sphere_light{};
  double light_inner_deg = 0;  // half angle of the cone of full intensity
  double light_intensity_w_sr = 1;
  int width = 640, height = 360;

  int add_material(ModelMaterial material) {
    materials.push_back(std::move(material));
    return static_cast<int>(materials.size()) - 1;
  }
  // A mesh, and a node that shows it where it is. Returns the mesh's index.
  int add(ModelMesh mesh) {
    nodes.push_back({mesh.name, static_cast<int>(meshes.size()), {}});
    meshes.push_back(std::move(mesh));
    return static_cast<int>(meshes.size()) - 1;
  }
  std::size_t triangle_count() const {
    std::size_t count = 0;
    for (const ModelNode& node : nodes) count += meshes[node.mesh].indices.size() / 3;
    for (const ModelPart& part : parts) count += part.triangles;
    return count;
  }
};

}  // namespace vsgl::scene
