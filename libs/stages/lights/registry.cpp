#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/find_method.h"
#include "math/lobe.h"
#include "math/sampling.h"
#include "stages/lights/lights.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

void check_params(const LightsMethod& method, const LightsParams& params) {
  if (params.count < 1 || params.count > static_cast<int>(interop::MAX_POINTS))
    throw Error(ErrorCode::out_of_range, "count: " + std::to_string(params.count) + " is outside 1..1048576");
  if (!(params.kernel_scale > 0 && std::isfinite(params.kernel_scale)))
    throw Error(ErrorCode::out_of_range, "kernel_scale: " + std::to_string(params.kernel_scale) +
                                             " is not above 0; 1 gives kernels that just meet");
  if (params.kernel_solver != "newton" && params.kernel_solver != "bisection")
    throw Error(ErrorCode::bad_value,
                "kernel_solver: \"" + params.kernel_solver + "\" is none of newton, bisection");
  if (params.power != "conserved" && params.power != "paper")
    throw Error(ErrorCode::bad_value, "power: \"" + params.power + "\" is none of conserved, paper");
  if (params.kmeans_iterations < 0 || params.kmeans_iterations > 20)
    throw Error(ErrorCode::out_of_range,
                "kmeans_iterations: " + std::to_string(params.kmeans_iterations) + " is outside 0..20");
  if (!(params.kmeans_normal_weight >= 0 && std::isfinite(params.kmeans_normal_weight)))
    throw Error(ErrorCode::out_of_range,
                "kmeans_normal_weight: " + std::to_string(params.kmeans_normal_weight) +
                    " is not 0 or above; 0 leaves normals aside");
  if (params.level < -1 || params.level > 64)
    throw Error(ErrorCode::out_of_range,
                "level: " + std::to_string(params.level) + " is outside -1..64; -1 takes the whole tree");
  if (params.environment_size < 8 || params.environment_size > 2048 ||
      !is_power_of_two(params.environment_size))
    throw Error(ErrorCode::out_of_range, "environment_size: " + std::to_string(params.environment_size) +
                                             " is not a power of two of 8..2048; try 512");
  if (params.vsl_neighbours < 1 || params.vsl_neighbours > 1000)
    throw Error(ErrorCode::out_of_range,
                "vsl_neighbours: " + std::to_string(params.vsl_neighbours) + " is outside 1..1000; try 10");
  if (!(params.vsl_radius_scale > 0 && std::isfinite(params.vsl_radius_scale)))
    throw Error(ErrorCode::out_of_range, "vsl_radius_scale: " + std::to_string(params.vsl_radius_scale) +
                                             " is not above 0; 1 reaches the k-th nearest light");
  check_pass(params.pass);
  if (params.pass.number > 1 && !method.has_passes)
    throw Error(ErrorCode::bad_value, "pass: method " + method.name +
                                          " makes the same lights in every pass; choose one that does not, "
                                          "as fis-2016");
  if (params.mutations < 0 || params.mutations > max_mutations)
    throw Error(ErrorCode::out_of_range, "mutations: " + std::to_string(params.mutations) +
                                             " is outside 0.." + std::to_string(max_mutations) +
                                             "; 1 a frame is usual");
  if (!(params.large_step >= 0 && params.large_step <= 1))
    throw Error(ErrorCode::out_of_range,
                "large_step: " + std::to_string(params.large_step) + " is no probability; give 0..1");
  point_set_kind(params.points);
  lobe_filter_kind(params.lobe_filter);
}

// The density must have been built from an RSM of the same layers.
void check_density(const Rsm& rsm, const Pdf& pdf) {
  const std::string remedy = "; build the density from this RSM";
  if (pdf.size != rsm.size)
    throw Error(ErrorCode::wrong_size, "density: " + std::to_string(pdf.size) +
                                           " texels a side, the RSM has " + std::to_string(rsm.size) +
                                           remedy);
  const bool same = std::equal(rsm.layers.begin(), rsm.layers.end(), pdf.layers.begin(), pdf.layers.end(),
                               [](const RsmLayer& a, const Pdf::Layer& b) { return a.name == b.name; });
  if (!same) throw Error(ErrorCode::missing_part, "density: its layers are not those of the RSM" + remedy);
}

// That lights of the method are made of what is given.
void check_source(const LightsMethod& method, LightsSource given) {
  if (method.source == given) return;
  const auto name_of = [](LightsSource source) {
    return source == LightsSource::environment ? "environment" : "sphere-lights";
  };
  if (given == LightsSource::rsm)
    throw Error(ErrorCode::missing_option,
                "method " + method.name + " makes no lights of an RSM; give --" + name_of(method.source));
  throw Error(ErrorCode::bad_value, "method: \"" + method.name + "\" is of another source; choose " +
                                        name_of(given) + ", or give what it makes lights of");
}

bool is_dark(const Pdf& pdf) {
  return std::all_of(pdf.layers.begin(), pdf.layers.end(),
                     [](const Pdf::Layer& layer) { return layer.pyramid.back() <= 0; });
}

}  // namespace

const std::vector<LightsMethod>& lights_methods() {
  static const std::vector<LightsMethod> methods = {
      {.name = "vpl",
       .summary = "virtual point lights: the sampled texels",
       .run = generate_vpl,
       .has_passes = true},
      {.name = "vsl",
       .summary = "virtual spherical lights: the sampled texels, as large as their k nearest are far",
       .run = generate_vsl,
       .has_passes = true},
      {.name = "fis-2014",
       .summary = "kernels sized by the density at their centres",
       .run = generate_fis_2014,
       .has_passes = true},
      {.name = "fis-2016",
       .summary = "kernels that hold equal shares of the samples",
       .run = generate_fis_2016,
       .has_passes = true},
      {.name = "metropolis",
       .summary = "as fis-2016, about Markov chains that go on from frame to frame",
       .run = generate_metropolis},
      {.name = "kmeans-2d",
       .summary = "every texel at the sampled texel that is nearest in the RSM",
       .run = generate_kmeans_2d},
      {.name = "kmeans-3d",
       .summary = "every texel at the sampled texel that is nearest in the scene",
       .run = generate_kmeans_3d},
      {.name = "texels",
       .summary = "every texel that reflects, neither sampled nor filtered",
       .needs_pdf = false,
       .run = generate_texels},
      {.name = "two-vsgl",
       .summary = "all texels as one diffuse and one specular light",
       .needs_pdf = false,
       .run = generate_two_vsgl},
      {.name = "tree",
       .summary = "every texel that reflects, and clusters of them level by level up to one of all",
       .needs_pdf = false,
       .needs_device = false,
       .run = generate_tree},
      {.name = "environment",
       .summary = "lights of an environment map, infinitely far away; kernels as of fis-2016",
       .needs_pdf = false,
       .run = nullptr,
       .source = LightsSource::environment},
      {.name = "sphere-lights",
       .summary = "the scene's sphere lights, a light each, which light it at first hand",
       .needs_pdf = false,
       .needs_device = false,
       .run = nullptr,
       .source = LightsSource::sphere_lights},
  };
  return methods;
}

const LightsMethod& lights_method(const std::string& name) {
  return find_method(lights_methods(), name);
}

Lights generate_lights(const Rsm& rsm, const Pdf* pdf, const LightsParams& params, gpu::Device* device,
                       Report& report) {
  const LightsMethod& method = lights_method(params.method);
  check_params(method, params);
  check_source(method, LightsSource::rsm);
  if (method.needs_pdf && !pdf)
    throw Error(ErrorCode::missing_option, "pdf: method " + method.name + " needs one; give --pdf pdf.exr");
  if (method.needs_device && !device)
    throw Error(ErrorCode::internal, "generate_lights: method " + method.name + " without a device");
  if (method.needs_pdf) check_density(rsm, *pdf);
  Lights out;
  out.method = method.name;
  out.anchor = rsm.anchor;
  out.scene_radius = rsm.scene_radius;
  if (method.needs_pdf && is_dark(*pdf)) {
    report.skipped("lights", "the density is zero everywhere: nothing emits");
  } else {
    LightSet set = method.run(rsm, pdf, params, device, report);
    out.lights = std::move(set.lights);
    out.levels = std::move(set.levels);
    out.chains = std::move(set.chains);
  }
  out.requested = method.needs_pdf ? params.count : static_cast<int>(out.lights.size());
  if (!out.is_tree())
    std::erase_if(out.lights, [](const interop::Light& light) { return !has_power(light); });
  report.count("lights", out.lights.size());
  report.count("dropped", static_cast<std::size_t>(out.requested) - out.lights.size());
  return out;
}

Lights generate_environment_lights(const scene::Environment& environment, const LightsParams& params,
                                   gpu::Device& device, Report& report) {
  const LightsMethod& method = lights_method(params.method);
  check_params(method, params);
  check_source(method, LightsSource::environment);
  Lights out;
  out.kind = LightsKind::environment;
  out.method = method.name;
  out.requested = params.count;
  out.lights = sample_environment(environment, params, device, report);
  report.count("lights", out.lights.size());
  report.count("dropped", static_cast<std::size_t>(out.requested) - out.lights.size());
  return out;
}

Lights generate_sphere_lights(const scene::Scene& scene, const LightsParams& params, Report& report) {
  const LightsMethod& method = lights_method(params.method);
  check_params(method, params);
  check_source(method, LightsSource::sphere_lights);
  if (scene.sphere_lights.empty())
    throw Error(
        ErrorCode::bad_light,
        "sphere_lights: the scene has none; add one under \"sphere_lights\", or choose another method");
  Lights out;
  out.method = method.name;
  out.anchor = scene.anchor;
  out.scene_radius = scene.radius;
  out.lights = make_sphere_lights(scene.sphere_lights);
  out.requested = static_cast<int>(out.lights.size());
  report.count("lights", out.lights.size());
  return out;
}

}  // namespace vsgl
