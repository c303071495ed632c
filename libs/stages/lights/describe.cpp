#include <algorithm>
#include <cmath>
#include <span>

#include "math/interop_vec.h"
#include "stages/lights/lights.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(interop::vec3 v) {
  return {v.x, v.y, v.z};
}

// Of a tree, what its leaves emit.
Vec3 emitted_power(const Lights& lights) {
  Vec3 sum;
  for (const interop::Light& light : lights.lights)
    if (light.children == 0) sum += to_double(light.power_diffuse) + to_double(light.power_specular);
  return sum;
}

Vec3 reflected_power(const Rsm& rsm) {
  Vec3 sum;
  const double texels = static_cast<double>(rsm.size) * rsm.size;
  for (const RsmLayer& layer : rsm.layers) {
    const interop::Moments& top = layer.pyramid.back();
    sum += (to_double(top.power_diffuse) + to_double(top.power_specular)) * texels;
  }
  return sum;
}

// Powers, and the luminance of the lights' over their source's (null where that is dark).
ordered_json power_statistics(const Lights& lights, Vec3 reflected) {
  const Vec3 emitted = emitted_power(lights);
  ordered_json ratio;
  if (luminance(reflected) > 0) ratio = luminance(emitted) / luminance(reflected);
  return {{"lights_w", to_array(emitted)}, {"rsm_w", to_array(reflected)}, {"ratio", ratio}};
}

ordered_json range_of(const Lights& lights, float interop::Light::*member) {
  double low = lights.lights.front().*member, high = low, sum = 0;
  for (const interop::Light& light : lights.lights) {
    const double value = light.*member;
    low = std::min(low, value);
    high = std::max(high, value);
    sum += value;
  }
  return {{"min", low}, {"mean", sum / static_cast<double>(lights.lights.size())}, {"max", high}};
}

// How many kernels lie at each mip level, rounded down.
std::vector<int> level_histogram(const Lights& lights) {
  std::vector<int> histogram;
  for (const interop::Light& light : lights.lights) {
    const auto level = static_cast<std::size_t>(light.level);
    if (level >= histogram.size()) histogram.resize(level + 1);
    ++histogram[level];
  }
  return histogram;
}

// Radius: root mean square distance of a node's points from their mean.
ordered_json tree_level(std::span<const interop::Light> nodes) {
  std::size_t leaves = 0;
  double sum = 0, largest = 0;
  for (const interop::Light& node : nodes) {
    const double radius = std::sqrt(2 * static_cast<double>(node.variance));
    leaves += node.children == 0;
    sum += radius;
    largest = std::max(largest, radius);
  }
  return {{"nodes", nodes.size()},
          {"leaves", leaves},
          {"radius_m", {{"mean", sum / static_cast<double>(nodes.size())}, {"max", largest}}}};
}

ordered_json tree_statistics(const Lights& tree) {
  ordered_json levels = ordered_json::array();
  for (std::size_t level = 0; level + 1 < tree.levels.size() && !tree.lights.empty(); ++level)
    levels.push_back(tree_level(
        std::span(tree.lights).subspan(tree.levels[level], tree.levels[level + 1] - tree.levels[level])));
  const auto texels = std::count_if(tree.lights.begin(), tree.lights.end(), [](const interop::Light& light) {
    return light.children == 0 && has_power(light);
  });
  return {{"lit_texels", texels}, {"depth", levels.size()}, {"levels", levels}};
}

ordered_json to_json(const interop::Light& light) {
  return {{"position_m", to_json(light.position)},
          {"variance_m2", light.variance},
          {"power_diffuse_w", to_json(light.power_diffuse)},
          {"axis_diffuse", to_json(light.diffuse_axis)},
          {"sharpness_diffuse", light.diffuse_sharpness},
          {"power_specular_w", to_json(light.power_specular)},
          {"axis_specular", to_json(light.specular_axis)},
          {"sharpness_specular", light.specular_sharpness},
          {"normal", to_json(light.normal)},
          {"normal_deficit", light.normal_deficit},
          {"origin_m", to_json(light.origin)},
          {"shading_normal", to_json(light.shading_normal)},
          {"incident", to_json(light.incident)},
          {"alpha", light.alpha},
          {"ndf", light.ndf},
          {"lobe_variance", light.lobe_variance},
          {"shading_deficit", light.shading_deficit},
          {"level", light.level},
          {"texel", light.texel},
          {"layer", light.layer},
          {"children", light.children}};
}

// `power`: of what the lights stand for.
ordered_json describe(const Lights& lights, Vec3 power, const LightsParams& params, bool dump) {
  const int count = static_cast<int>(lights.lights.size());
  ordered_json out = {{"$schema", "vsgltools/lights/1"},
                      {"method", lights.method},
                      {"points", params.points},
                      {"kernel_scale", params.kernel_scale},
                      {"kernel_solver", params.kernel_solver},
                      {"power_rule", params.power},
                      {"lobe_filter", params.lobe_filter},
                      {"seed", params.seed},
                      {"anchor_m", to_array(lights.anchor)},
                      {"scene_radius_m", lights.scene_radius},
                      {"requested", lights.requested},
                      {"count", count},
                      {"dropped", lights.requested - count},
                      {"power", power_statistics(lights, power)}};
  if (count > 0) {
    out["level"] = range_of(lights, &interop::Light::level);
    out["level"]["histogram"] = level_histogram(lights);
    out["variance_m2"] = range_of(lights, &interop::Light::variance);
  }
  if (lights.is_tree()) out["tree"] = tree_statistics(lights);
  if (!lights.chains.states.empty())
    out["chains"] = {{"count", lights.chains.states.size()}, {"steps", lights.chains.steps}};
  if (dump) {
    out["lights"] = ordered_json::array();
    for (const interop::Light& light : lights.lights) out["lights"].push_back(to_json(light));
  }
  return out;
}

}  // namespace

ordered_json describe(const Lights& lights, const Rsm& rsm, const LightsParams& params, bool dump) {
  return describe(lights, reflected_power(rsm), params, dump);
}

ordered_json describe(const Lights& lights, const scene::Environment& environment, const LightsParams& params,
                      bool dump) {
  return describe(lights, environment_power(environment), params, dump);
}

}  // namespace vsgl
