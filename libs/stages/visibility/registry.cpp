#include <cmath>

#include "base/error.h"
#include "base/find_method.h"
#include "stages/visibility/aism.h"
#include "stages/visibility/ism.h"
#include "stages/visibility/maps.h"
#include "stages/visibility/none.h"
#include "stages/visibility/ratio.h"
#include "stages/visibility/rays.h"
#include "stages/visibility/raytraced.h"
#include "stages/visibility/tessellated.h"
#include "stages/visibility/visibility.h"

namespace vsgl {
namespace {

// From about here on rays cost more than three times the ratio estimator; docs/visibility.md has the
// measurement.
constexpr std::size_t kManyTriangles = 400'000;

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
  check_range("error", params.error, 1e-5, 1.0);
  check_range("level", params.level, -1, 32);
  check_range("rays", params.rays, 1, 64);
  if (!is_power_of_two(params.tile))
    throw Error(ErrorCode::out_of_range,
                "tile: " + std::to_string(params.tile) + " is not a power of two; try 64");
}

void check_lights(const VisibilityMethod& method, const VisibilityInputs& inputs) {
  const Lights& lights = inputs.lights;
  if (!(lights.is_tree() ? method.for_trees : method.for_lists))
    throw Error(ErrorCode::bad_value, "method: \"" + method.name + "\" is not for a " +
                                          (lights.is_tree() ? "tree" : "list") +
                                          " of lights; choose another one, or \"auto\"");
  if (lights.kind == LightsKind::environment) {
    if (!method.for_environments)
      throw Error(ErrorCode::bad_value, "method: \"" + method.name +
                                            "\" is not for lights of an environment, which have no place; choose "
                                            "raytraced or \"auto\"");
  } else if (!(inputs.scene.anchor == lights.anchor))
    throw Error(ErrorCode::invalid_data,
                "lights: their anchor is not the scene's; generate them from this scene");
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const auto& n = lights.lights[i].normal;
    if (!(std::abs(std::hypot(n.x, n.y, n.z) - 1) < 1e-3f))
      throw Error(ErrorCode::invalid_data, "lights: channel \"normal\" of light " + std::to_string(i) +
                                               " is not a unit vector; generate the lights again");
  }
}

void check_gbuffer(const VisibilityMethod& method, const VisibilityInputs& inputs) {
  if (!method.needs_gbuffer && !inputs.lights.is_tree()) return;  // every cut needs one
  if (!inputs.gbuffer)
    throw Error(ErrorCode::missing_option,
                "gbuffer: method " + method.name + " needs one; give --gbuffer gbuffer.exr");
  if (!(inputs.gbuffer->anchor == inputs.scene.anchor))
    throw Error(ErrorCode::invalid_data,
                "gbuffer: its anchor is not the scene's; bake it from the same scene");
}

void check_cut(const VisibilityMethod& method, const VisibilityInputs& inputs) {
  const Cut* cut = inputs.cut;
  if (!cut) return;
  if (!method.for_trees)
    throw Error(ErrorCode::conflicting_options,
                "cut: method " + method.name + " finds the visibility of a list of lights; drop --cut");
  if (cut->width != inputs.gbuffer->width || cut->height != inputs.gbuffer->height ||
      cut->lights != static_cast<int>(inputs.lights.lights.size()))
    throw Error(ErrorCode::wrong_size,
                "cut: it is of another image or another tree; choose it from this G-buffer and these lights");
  if (!(cut->anchor == inputs.lights.anchor))
    throw Error(ErrorCode::invalid_data, "cut: its anchor is not the lights'; choose it from these lights");
}

const VisibilityMethod& row(const std::string& name) {
  return find_method(visibility_methods(), name);
}

}  // namespace

const std::vector<VisibilityMethod>& visibility_methods() {
  static const std::vector<VisibilityMethod> methods = {
      {.name = "auto",
       .summary = "ism for a list of lights, raytraced for an environment's, rays or ratio for a tree",
       .for_lists = true,
       .for_environments = true,
       .for_trees = true},
      {.name = "ism",
       .summary = "imperfect shadow maps: surface points splatted into a hemisphere per light",
       .for_lists = true,
       .needs_device = true,
       .run = visibility::build_ism},
      {.name = "aism",
       .summary = "the same with points that are denser where they may shadow what the camera sees",
       .for_lists = true,
       .needs_gbuffer = true,
       .needs_device = true,
       .run = visibility::build_aism},
      {.name = "tessellated",
       .summary = "the same with points from a subdivision of the triangles, made per light on the device",
       .for_lists = true,
       .needs_device = true,
       .run = visibility::build_tessellated},
      {.name = "raytraced",
       .summary = "exact: a ray from each pixel to the point that represents each light",
       .for_lists = true,
       .for_environments = true,
       .needs_gbuffer = true,
       .run = visibility::trace_visibility},
      {.name = "rays",
       .summary = "the cut of a light tree, with rays from 16 pixels a tile and from all where they disagree",
       .for_trees = true,
       .needs_gbuffer = true,
       .run = visibility::trace_cut},
      {.name = "maps",
       .summary = "the same with imperfect shadow maps of one level of the tree in place of rays",
       .for_trees = true,
       .needs_gbuffer = true,
       .needs_device = true,
       .run = visibility::map_cut},
      {.name = "ratio",
       .summary = "a preview: the cut without shadows, dimmed by the share of light that a few rays a pixel see",
       .for_trees = true,
       .needs_gbuffer = true,
       .run = visibility::estimate_ratio},
      {.name = "none",
       .summary = "everything is seen: no shadows",
       .for_lists = true,
       .for_environments = true,
       .for_trees = true,
       .run = visibility::build_none},
  };
  return methods;
}

VisibilityChoice choose_visibility(const VisibilityInputs& inputs, const VisibilityParams& params) {
  if (params.method != "auto") return {row(params.method), "asked for"};
  if (inputs.lights.kind == LightsKind::environment)
    return {row("raytraced"), "the lights are an environment's"};
  if (!inputs.lights.is_tree()) return {row("ism"), "the lights are a list"};
  const std::size_t triangles = inputs.scene.triangle_count();
  const std::string count = "the lights are a tree, and " + std::to_string(triangles) + " triangles are ";
  if (triangles > kManyTriangles)
    return {row("ratio"), count + "more than " + std::to_string(kManyTriangles) + ": many for rays"};
  return {row("rays"), count + "at most " + std::to_string(kManyTriangles)};
}

Visibility build_visibility(const VisibilityInputs& inputs, const VisibilityParams& params,
                            gpu::Device* device, Report& report) {
  const auto& [method, reason] = choose_visibility(inputs, params);
  check_params(params);
  check_lights(method, inputs);
  check_gbuffer(method, inputs);
  check_cut(method, inputs);
  if (method.needs_device && !device)
    throw Error(ErrorCode::internal, "build_visibility: method " + method.name + " without a device");
  report.count("visibility_method", method.name);
  report.count("visibility_reason", reason);
  return method.run(inputs, params, device, report);
}

}  // namespace vsgl
