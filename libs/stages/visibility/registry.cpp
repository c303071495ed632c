#include <cmath>

#include "base/error.h"
#include "base/find_method.h"
#include "stages/visibility/ism.h"
#include "stages/visibility/raytraced.h"
#include "stages/visibility/visibility.h"

namespace vsgl {
namespace {

template <class T>
void check_range(const char* name, T value, T low, T high) {
  if (value >= low && value <= high) return;
  throw Error(ErrorCode::out_of_range, std::string(name) + ": " + std::to_string(value) + " is outside " +
                                           std::to_string(low) + ".." + std::to_string(high));
}

void check_params(const VisibilityParams& params) {
  check_range("points per light", params.points_per_light, 1, 1 << 20);
  check_range("tile", params.tile, 8, 512);
  check_range("splat scale", params.splat_scale, 0.0, 4.0);
  if (!is_power_of_two(params.tile))
    throw Error(ErrorCode::out_of_range,
                "tile: " + std::to_string(params.tile) + " is not a power of two; try 64");
}

void check_lights(const scene::Scene& scene, const Lights& lights) {
  if (!(scene.anchor == lights.anchor))
    throw Error(ErrorCode::invalid_data,
                "lights: their anchor is not the scene's; generate them from this scene");
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const auto& n = lights.lights[i].normal;
    if (!(std::abs(std::hypot(n.x, n.y, n.z) - 1) < 1e-3f))
      throw Error(ErrorCode::invalid_data, "lights: channel \"normal\" of light " + std::to_string(i) +
                                               " is not a unit vector; generate the lights again");
  }
}

void check_gbuffer(const VisibilityMethod& method, const GBuffer* gbuffer, const Lights& lights) {
  if (!method.needs_gbuffer) return;
  if (!gbuffer)
    throw Error(ErrorCode::missing_option,
                "gbuffer: method " + method.name + " needs one; give --gbuffer gbuffer.exr");
  if (!(gbuffer->anchor == lights.anchor))
    throw Error(ErrorCode::invalid_data,
                "gbuffer: its anchor is not the lights'; bake it from the same scene");
}

}  // namespace

const std::vector<VisibilityMethod>& visibility_methods() {
  static const std::vector<VisibilityMethod> methods = {
      {.name = "ism",
       .summary = "imperfect shadow maps: surface points splatted into a hemisphere per light",
       .needs_device = true,
       .run = visibility::build_ism},
      {.name = "raytraced",
       .summary = "exact: a ray from each pixel to the point that represents each light",
       .needs_gbuffer = true,
       .run = visibility::trace_visibility},
  };
  return methods;
}

const VisibilityMethod& visibility_method(const std::string& name) {
  return find_method(visibility_methods(), name);
}

Visibility build_visibility(const scene::Scene& scene, const Lights& lights, const GBuffer* gbuffer,
                            const VisibilityParams& params, gpu::Device* device, Report& report) {
  const auto& method = visibility_method(params.method);
  check_params(params);
  check_lights(scene, lights);
  check_gbuffer(method, gbuffer, lights);
  if (method.needs_device && !device)
    throw Error(ErrorCode::internal, "build_visibility: method " + method.name + " without a device");
  return method.run(scene, lights, gbuffer, params, device, report);
}

}  // namespace vsgl
