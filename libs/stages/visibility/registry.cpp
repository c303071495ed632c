#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "stages/visibility/ism.h"
#include "stages/visibility/visibility.h"

namespace vsgl {
namespace {

constexpr std::size_t max_atlas_texels = std::size_t{1} << 28;

template <class T>
void check_range(const char* name, T value, T low, T high) {
  if (value >= low && value <= high) return;
  throw Error(ErrorCode::out_of_range, std::string(name) + ": " + std::to_string(value) + " is outside " +
                                           std::to_string(low) + ".." + std::to_string(high));
}

void check_params(const VisibilityParams& params, std::size_t light_count) {
  check_range("points per light", params.points_per_light, 1, 1 << 20);
  check_range("tile", params.tile, 8, 512);
  check_range("splat scale", params.splat_scale, 0.0, 4.0);
  if (!is_power_of_two(params.tile))
    throw Error(ErrorCode::out_of_range,
                "tile: " + std::to_string(params.tile) + " is not a power of two; try 64");
  const std::size_t texels =
      light_count * static_cast<std::size_t>(params.tile) * static_cast<std::size_t>(params.tile);
  if (texels > max_atlas_texels)
    throw Error(ErrorCode::out_of_range,
                "tile: " + std::to_string(light_count) + " maps of " + std::to_string(params.tile) +
                    " texels a side need more than 2^28 texels; use smaller tiles or fewer lights");
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

const VisibilityMethod& find_method(const std::string& name) {
  const auto& methods = visibility_methods();
  const auto found =
      std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.name == name; });
  if (found != methods.end()) return *found;
  std::string names;
  for (const auto& m : methods) names += (names.empty() ? "" : ", ") + m.name;
  throw Error(ErrorCode::bad_value, "method: \"" + name + "\" is none of " + names);
}

}  // namespace

const std::vector<VisibilityMethod>& visibility_methods() {
  static const std::vector<VisibilityMethod> methods = {
      {"ism", "imperfect shadow maps: surface points splatted into a hemisphere per light",
       visibility::build_ism},
  };
  return methods;
}

ShadowMaps build_shadow_maps(const scene::Scene& scene, const Lights& lights, const VisibilityParams& params,
                             gpu::Device& device, Report& report) {
  const auto& method = find_method(params.method);
  check_params(params, lights.lights.size());
  check_lights(scene, lights);
  if (lights.lights.empty()) {
    report.skipped("all shadow maps", "there are no lights");
    ShadowMaps none;
    none.tile = params.tile;
    none.anchor = lights.anchor;
    return none;
  }
  return method.run(scene, lights, params, device, report);
}

}  // namespace vsgl
