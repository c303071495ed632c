#include "scene/scene_views.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/strict_json.h"

namespace vsgl::scene {
namespace {

namespace fs = std::filesystem;

// glTF's cameras and lights look down their node's -z, with +y up.
bool view_frame(const Mat4& transform, Vec3& right, Vec3& up, Vec3& forward) {
  return make_frame(transform.direction({0, 0, -1}), transform.direction({0, 1, 0}), right, up, forward);
}

// Camera

[[noreturn]] void bad_camera(const fs::path& json_path, const std::string& what) {
  throw Error(ErrorCode::bad_camera, json_path.string() + ": " + what);
}

const GltfCamera& source_of(const PlacedNode& placed) {
  return placed.file->cameras[placed.node->camera];
}

// The node with the camera of that name; the name may be the camera's or the node's.
const PlacedNode& named_camera(const std::vector<const PlacedNode*>& cameras, const std::string& name,
                               const fs::path& json_path) {
  std::vector<std::string> names;
  for (const PlacedNode* placed : cameras) {
    const GltfCamera& camera = source_of(*placed);
    names.insert(names.end(), {placed->node->name, camera.name});
    if (name != placed->node->name && name != camera.name) continue;
    if (!camera.perspective) {
      bad_camera(json_path,
                 "camera \"" + name + "\" is orthographic; only perspective cameras are supported");
    }
    return *placed;
  }
  const std::string nearest = nearest_name(name, names);
  bad_camera(json_path, "no glTF camera is called \"" + name + "\"" +
                            (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

Camera gltf_camera(const PlacedNode& placed, const fs::path& json_path) {
  Camera out;
  out.position = placed.transform.point({});
  out.tan_y = std::tan(source_of(placed).vertical_fov / 2);
  if (!view_frame(placed.transform, out.right, out.up, out.forward)) {
    bad_camera(json_path, "the transform of camera \"" + placed.node->name + "\" flattens space");
  }
  return out;
}

Camera gltf_camera(const SceneSpec& spec, const std::vector<PlacedNode>& nodes, const fs::path& json_path,
                   std::vector<std::string>& warnings) {
  std::vector<const PlacedNode*> cameras;
  for (const PlacedNode& placed : nodes)
    if (placed.node->camera >= 0) cameras.push_back(&placed);
  if (spec.gltf_camera) return gltf_camera(named_camera(cameras, *spec.gltf_camera, json_path), json_path);
  if (cameras.size() > 1) {
    warnings.push_back(json_path.string() +
                       ": the files have several cameras; the first perspective one is used");
  }
  for (const PlacedNode* placed : cameras)
    if (source_of(*placed).perspective) return gltf_camera(*placed, json_path);
  bad_camera(json_path,
             "the scene has no camera; give position, target and vertical_fov_deg under \"camera\"");
}

// Lights

LightSource gltf_light(const PlacedNode& placed, double lumens_per_watt, const fs::path& json_path) {
  const GltfLight& source = placed.file->lights[placed.node->light];
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorCode::bad_light, json_path.string() + ": light \"" + placed.node->name + "\": " + what);
  };
  LightSource out;
  out.name = placed.node->name;
  out.type = source.type;
  out.position = placed.transform.point({});
  out.intensity = source.intensity / lumens_per_watt;
  if (out.type == LightType::point) return out;
  if (!view_frame(placed.transform, out.right, out.up, out.forward)) fail("its transform flattens space");
  if (out.type == LightType::spot) {
    if (source.inner_cone > source.outer_cone) fail("the inner cone is wider than the outer one");
    constexpr double narrowest = 1.7e-4, widest = 1.5534;  // 0.01 and 89 degrees
    if (source.outer_cone < narrowest || source.outer_cone > widest) {
      fail("the outer cone's half angle must be from 0.01 to 89 degrees; use a point light for more");
    }
    out.cos_inner = std::cos(source.inner_cone);
    out.cos_outer = std::cos(source.outer_cone);
    out.extent_x = out.extent_y = std::tan(source.outer_cone);
  }
  return out;
}

void make_name_unique(LightSource& light, const std::vector<LightSource>& others) {
  const std::string name = light.name;
  const auto taken = [&] {
    return std::any_of(others.begin(), others.end(),
                       [&](const auto& other) { return other.name == light.name; });
  };
  for (int i = 2; taken(); ++i) light.name = name + "-" + std::to_string(i);
}

}  // namespace

Camera choose_camera(const SceneSpec& spec, const std::vector<PlacedNode>& nodes, Vec3 anchor,
                     const fs::path& json_path, std::vector<std::string>& warnings) {
  Camera camera;
  if (spec.camera) {
    camera = *spec.camera;
    camera.position = camera.position - anchor;
  } else {
    camera = gltf_camera(spec, nodes, json_path, warnings);
  }
  camera.width = spec.width;
  camera.height = spec.height;
  camera.tan_x = camera.tan_y * spec.width / spec.height;
  return camera;
}

std::vector<LightSource> collect_lights(const SceneSpec& spec, const std::vector<PlacedNode>& nodes,
                                        Vec3 anchor, double radius, const fs::path& json_path,
                                        std::vector<std::string>& warnings) {
  std::vector<LightSource> out;
  const auto add = [&](LightSource light) {
    if (light.intensity == Vec3{}) {
      warnings.push_back(json_path.string() + ": light \"" + light.name + "\" emits nothing and is left out");
      return;
    }
    if (light.type == LightType::directional) {
      light.position = {};
      light.extent_x = light.extent_y = radius;
    }
    make_name_unique(light, out);
    out.push_back(std::move(light));
  };
  if (spec.lights) {
    for (LightSource light : *spec.lights) {
      light.position = light.position - anchor;
      add(std::move(light));
    }
  } else {
    for (const PlacedNode& placed : nodes)
      if (placed.node->light >= 0) add(gltf_light(placed, spec.lumens_per_watt, json_path));
  }
  if (out.empty() && !spec.environment) {
    throw Error(
        ErrorCode::bad_light,
        json_path.string() + ": the scene has no light; add one under \"lights\" or to the glTF file");
  }
  return out;
}

}  // namespace vsgl::scene
