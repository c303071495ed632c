#include "base/error.h"
#include "base/find_method.h"
#include "stages/shading/methods.h"
#include "stages/shading/shading.h"

namespace vsgl {
namespace {

constexpr double kAnchorTolerance = 1e-6;  // of the scene's radius

void require_range(const char* name, double value, double minimum, double maximum) {
  if (!(value >= minimum && value <= maximum))
    throw Error(ErrorCode::out_of_range, std::string(name) + ": " + std::to_string(value) + " is outside " +
                                             std::to_string(minimum) + ".." + std::to_string(maximum) +
                                             "; choose a value within");
}

void require_light_count(const std::string& what, std::size_t found, const Lights& lights) {
  if (found != lights.lights.size())
    throw Error(ErrorCode::wrong_size, what + ": " + std::to_string(found) + " for " +
                                           std::to_string(lights.lights.size()) +
                                           " lights; make them from these lights");
}

void require_image_size(const std::string& what, int width, int height, const GBuffer& gbuffer,
                        const std::string& remedy) {
  if (width != gbuffer.width || height != gbuffer.height)
    throw Error(ErrorCode::wrong_size, what + ": of " + std::to_string(width) + "x" + std::to_string(height) +
                                           " pixels for a G-buffer of " + std::to_string(gbuffer.width) +
                                           "x" + std::to_string(gbuffer.height) + "; " + remedy);
}

// Sphere lights belong to no surface: they send light to all sides, and there is no exact emission to take the
// place of their SG. Nothing is known of their shadows.
bool are_sphere_lights(const Lights& lights) {
  return lights.method == "sphere-lights";
}
void require_sphere_lights(const LightModel& model, const Visibility* visibility, const ShadingParams& params) {
  const std::string what = " does not fit sphere lights";
  if (model.name != "vsgl")
    throw Error(ErrorCode::bad_value, "light_model: \"" + model.name + "\"" + what + "; choose vsgl");
  if (params.cbr > 0)
    throw Error(ErrorCode::bad_value, "cbr: " + std::to_string(params.cbr) + what + ", which have no BRDF; give 0");
  if (visibility && !std::holds_alternative<Unshadowed>(*visibility))
    throw Error(ErrorCode::bad_value, "visibility" + what + "; leave it out");
}

// Lights of an environment fit any scene, but not any light model.
void require_kind(const LightModel& model, const Lights& lights, const GBuffer& gbuffer) {
  if (lights.kind == LightsKind::points) {
    require_same_anchor("lights", lights.anchor, gbuffer);
  } else if (model.name != "vsgl") {
    throw Error(ErrorCode::bad_value, "light_model: \"" + model.name +
                                          "\" cannot shade with lights of an environment; choose vsgl");
  }
}

void check_visibility(const ShadowMaps& maps, const GBuffer& gbuffer, const Lights& lights) {
  require_same_anchor("shadow maps", maps.anchor, gbuffer);
  require_light_count("shadow maps", maps.views.size(), lights);
}

void check_visibility(const VisibilityBits& bits, const GBuffer& gbuffer, const Lights& lights) {
  require_same_anchor("visibility bits", bits.anchor, gbuffer);
  require_light_count("visibility bits", static_cast<std::size_t>(bits.lights), lights);
  require_image_size("visibility bits", bits.width, bits.height, gbuffer, "trace them for this G-buffer");
}

void check_visibility(const Unshadowed& unshadowed, const GBuffer& gbuffer, const Lights& lights) {
  require_same_anchor("visibility", unshadowed.anchor, gbuffer);
  require_light_count("visibility", static_cast<std::size_t>(unshadowed.lights), lights);
}

void check_visibility(const Cut& cut, const GBuffer& gbuffer, const Lights& lights) {
  require_same_anchor("cut", cut.anchor, gbuffer);
  require_light_count("cut", static_cast<std::size_t>(cut.lights), lights);
  require_image_size("cut", cut.width, cut.height, gbuffer, "make it for this G-buffer");
}

}  // namespace

void require_same_anchor(const std::string& what, Vec3 anchor, const GBuffer& gbuffer) {
  if (length(anchor - gbuffer.anchor) > kAnchorTolerance * gbuffer.scene_radius)
    throw Error(ErrorCode::invalid_data,
                what + ": anchor differs from the G-buffer's; make both from the same scene");
}

const std::vector<LightModel>& light_models() {
  static const std::vector<LightModel> models = {
      {"fvpl", "filtered virtual point lights: clusters with their mean BRDF", shade_fvpl, true},
      {"vpl", "virtual point lights with the true BRDFs and a floor of the distance", shade_vpl},
      {"vsl", "virtual spherical lights: the true BRDFs over a light's cone, by Monte Carlo", shade_vsl},
      {"vsgl", "virtual spherical Gaussian lights with Gaussian footprints (2016)", shade_vsgl, true},
      {"vsgl-2014", "virtual spherical Gaussian lights as disks (2014)", shade_vsgl_2014, true},
  };
  return models;
}

std::string resolve_schedule(const ShadingParams& params, const Lights& lights) {
  const std::string& schedule = params.schedule;
  if (schedule == "auto") return lights.is_tree() ? "cut" : "flat";
  if (schedule != "flat" && schedule != "interleave" && schedule != "cut")
    throw Error(ErrorCode::bad_value,
                "schedule: \"" + schedule + "\" is none of auto, flat, interleave, cut");
  if (schedule == "cut" && !lights.is_tree())
    throw Error(ErrorCode::bad_value,
                "schedule: \"cut\" needs a light tree, and the lights are a list; make them with vsgl-gen "
                "--method tree, or choose flat or interleave");
  if (schedule != "cut" && lights.is_tree())
    throw Error(ErrorCode::bad_value, "schedule: \"" + schedule +
                                          "\" needs a list, and the lights are a tree; choose cut, or make a "
                                          "list of one of its levels with vsgl-gen --level");
  return schedule;
}

Indirect shade(const GBuffer& gbuffer, const Lights& lights, const Visibility* visibility,
               const ShadingParams& params, gpu::Device& device, Report& report) {
  const LightModel& model = find_method(light_models(), params.light_model, "light_model");
  if (are_sphere_lights(lights)) require_sphere_lights(model, visibility, params);
  const std::string schedule = resolve_schedule(params, lights);
  require_specular_lobe(model, schedule, params);
  if (params.interleave != 1 && params.interleave != 2 && params.interleave != 4 && params.interleave != 8)
    throw Error(ErrorCode::out_of_range,
                "interleave: " + std::to_string(params.interleave) + " is none of 1, 2, 4, 8");
  require_range("clamp", params.clamp, 0, 1);
  require_range("cbr", params.cbr, 0, 1);
  require_range("diffuse_scale", params.diffuse_scale, 1, 2);
  check_pass(params.pass);
  require_range("vsl_samples", params.vsl_samples, 1, 4096);
  require_kind(model, lights, gbuffer);
  if (visibility) std::visit([&](const auto& v) { check_visibility(v, gbuffer, lights); }, *visibility);
  const Cut* cut = std::get_if<Cut>(visibility);
  if (schedule == "cut") {
    if (model.name != "fvpl")
      throw Error(ErrorCode::bad_value, "light_model: \"" + model.name +
                                            "\" cannot shade by a cut; choose fvpl, or make a list of lights "
                                            "with vsgl-gen --level");
    if (!cut)
      throw Error(ErrorCode::bad_value,
                  "schedule: \"cut\" needs the cut of this light tree and image; give "
                  "what ismap or light-cut has made of them");
    return shade_cut(gbuffer, lights, *cut, params, device, report);
  }
  if (cut)
    throw Error(ErrorCode::bad_value,
                "visibility: a cut, and the lights are a list; make shadow maps or "
                "visibility bits of them with ismap");
  return model.run(gbuffer, lights, visibility, params, device, report);
}

}  // namespace vsgl
