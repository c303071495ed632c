#include "stages/rsm/views.h"

#include <algorithm>
#include <array>
#include <set>

#include "base/error.h"
#include "math/interop_vec.h"
#include "math/light_view.h"
#include "stages/rsm/rsm.h"

namespace vsgl {
namespace {

// Nearer surfaces are not drawn, as a fraction of the scene's radius.
constexpr double kNear = 1e-4;
// Room about the bounding sphere in a directional light's view, so that rounding cuts nothing off.
constexpr double kFrameMargin = 1.001;

// Points along a side of a texel at which its intensity is taken: the more, the fewer texels there are on
// that axis.
interop::uint samples_along(int texels) {
  return static_cast<interop::uint>(std::clamp(256 / texels, 4, 64));
}

void require_sound(const LightSource& light) {
  const double sum = length(light.intensity) + length(light.position) + length(light.forward) +
                     light.extent_x + light.extent_y + light.cos_inner + light.cos_outer;
  if (!std::isfinite(sum) || length(light.forward) == 0 || light.extent_x <= 0 || light.extent_y <= 0) {
    throw Error(ErrorCode::bad_light,
                "light \"" + light.name +
                    "\": position, direction, intensity or cone is not finite or has no extent; "
                    "correct the scene file");
  }
}

LightView frame_directional(LightSource light, double scene_radius) {
  const double reach = kFrameMargin * scene_radius;
  light.position = -reach * light.forward;
  light.extent_x = light.extent_y = reach;
  return {light.name, light};
}

std::vector<LightView> cube_faces(const LightSource& light) {
  struct Face {
    const char* suffix;
    Vec3 forward, up;
  };
  const std::array<Face, 6> faces{{{".px", {1, 0, 0}, {0, 1, 0}},
                                   {".nx", {-1, 0, 0}, {0, 1, 0}},
                                   {".py", {0, 1, 0}, {0, 0, 1}},
                                   {".ny", {0, -1, 0}, {0, 0, -1}},
                                   {".pz", {0, 0, 1}, {0, 1, 0}},
                                   {".nz", {0, 0, -1}, {0, 1, 0}}}};
  std::vector<LightView> views;
  for (const Face& face : faces) {
    LightSource side = light;
    side.forward = face.forward;
    side.up = face.up;
    side.right = cross(face.forward, face.up);
    side.extent_x = side.extent_y = 1;
    views.push_back({light.name + face.suffix, side});
  }
  return views;
}

}  // namespace

std::vector<LightView> light_views(const scene::Scene& scene) {
  if (scene.lights.empty())
    throw Error(
        ErrorCode::bad_light,
        "the scene has no light that an RSM shows; add a light, or take the lights of its environment or "
        "its sphere lights");
  std::vector<LightView> views;
  for (const LightSource& light : scene.lights) {
    require_sound(light);
    if (light.type == LightType::spot) {
      views.push_back({light.name, light});
    } else if (light.type == LightType::directional) {
      views.push_back(frame_directional(light, scene.radius));
    } else {
      const std::vector<LightView> faces = cube_faces(light);
      views.insert(views.end(), faces.begin(), faces.end());
    }
  }
  std::set<std::string> names;
  for (const LightView& view : views) {
    if (!names.insert(view.name).second) {
      throw Error(ErrorCode::bad_light,
                  "light \"" + view.name + "\": there are two of that name; rename one");
    }
  }
  return views;
}

interop::View camera_view(const scene::Camera& camera, double scene_radius) {
  interop::View view{};
  view.origin = to_float(camera.position);
  view.kind = interop::VIEW_CAMERA;
  view.right = to_float(camera.right);
  view.extent_x = static_cast<float>(camera.tan_x);
  view.up = to_float(camera.up);
  view.extent_y = static_cast<float>(camera.tan_y);
  view.forward = to_float(camera.forward);
  view.near_far = static_cast<float>(kNear * scene_radius);
  view.width = static_cast<interop::uint>(camera.width);
  view.height = static_cast<interop::uint>(camera.height);
  return view;
}

interop::View light_view(const LightSource& light, double scene_radius, int width, int height) {
  interop::View view = light_view(light, width, height);
  const bool parallel = light.type == LightType::directional;
  view.near_far = static_cast<float>(parallel ? 2 * kFrameMargin * scene_radius : kNear * scene_radius);
  view.samples_x = samples_along(width);
  view.samples_y = samples_along(height);
  return view;
}

scene::Camera with_resolution(scene::Camera camera, int width, int height) {
  camera.tan_x = camera.tan_y * width / height;
  camera.width = width;
  camera.height = height;
  return camera;
}

}  // namespace vsgl
