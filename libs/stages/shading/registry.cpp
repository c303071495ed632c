#include "base/error.h"
#include "base/find_method.h"
#include "stages/shading/methods.h"
#include "stages/shading/shading.h"

namespace vsgl {
namespace {

constexpr double kAnchorTolerance = 1e-6;  // of the scene's radius

void require_range(const char* name, double value, double maximum) {
  if (!(value >= 0 && value <= maximum))
    throw Error(ErrorCode::out_of_range, std::string(name) + ": " + std::to_string(value) +
                                             " is outside 0.." + std::to_string(maximum) +
                                             "; choose a value within");
}

void require_light_count(const std::string& what, std::size_t found, const Lights& lights) {
  if (found != lights.lights.size())
    throw Error(ErrorCode::wrong_size, what + ": " + std::to_string(found) + " for " +
                                           std::to_string(lights.lights.size()) +
                                           " lights; make them from these lights");
}

void check_visibility(const ShadowMaps& maps, const GBuffer& gbuffer, const Lights& lights) {
  require_same_anchor("shadow maps", maps.anchor, gbuffer);
  require_light_count("shadow maps", maps.views.size(), lights);
}

void check_visibility(const VisibilityBits& bits, const GBuffer& gbuffer, const Lights& lights) {
  require_same_anchor("visibility bits", bits.anchor, gbuffer);
  require_light_count("visibility bits", static_cast<std::size_t>(bits.lights), lights);
  if (bits.width != gbuffer.width || bits.height != gbuffer.height)
    throw Error(ErrorCode::wrong_size, "visibility bits: of " + std::to_string(bits.width) + "x" +
                                           std::to_string(bits.height) + " pixels for a G-buffer of " +
                                           std::to_string(gbuffer.width) + "x" +
                                           std::to_string(gbuffer.height) + "; trace them for this G-buffer");
}

void check_visibility(const Cut& cut, const GBuffer& gbuffer, const Lights& lights) {
  require_same_anchor("cut", cut.anchor, gbuffer);
  require_light_count("cut", static_cast<std::size_t>(cut.lights), lights);
  if (cut.width != gbuffer.width || cut.height != gbuffer.height)
    throw Error(ErrorCode::wrong_size, "cut: of " + std::to_string(cut.width) + "x" +
                                           std::to_string(cut.height) + " pixels for a G-buffer of " +
                                           std::to_string(gbuffer.width) + "x" +
                                           std::to_string(gbuffer.height) + "; make it for this G-buffer");
}

}  // namespace

void require_same_anchor(const std::string& what, Vec3 anchor, const GBuffer& gbuffer) {
  if (length(anchor - gbuffer.anchor) > kAnchorTolerance * gbuffer.scene_radius)
    throw Error(ErrorCode::invalid_data,
                what + ": anchor differs from the G-buffer's; make both from the same scene");
}

const std::vector<ShadingMethod>& shading_methods() {
  static const std::vector<ShadingMethod> methods = {
      {"vpl", "virtual point lights with the true BRDFs and a floor of the distance", shade_vpl},
      {"vsgl", "virtual spherical Gaussian lights with Gaussian footprints (2016)", shade_vsgl},
      {"vsgl-2014", "virtual spherical Gaussian lights as disks (2014)", shade_vsgl_2014},
  };
  return methods;
}

Indirect shade(const GBuffer& gbuffer, const Lights& lights, const Visibility* visibility,
               const ShadingParams& params, gpu::Device& device, Report& report) {
  const ShadingMethod& method = find_method(shading_methods(), params.method);
  if (params.specular_lobe != "auto" && params.specular_lobe != "asg")
    throw Error(ErrorCode::bad_value, "specular_lobe: \"" + params.specular_lobe + "\" is none of auto, asg");
  require_range("clamp", params.clamp, 1);
  require_range("cbr", params.cbr, 1);
  require_same_anchor("lights", lights.anchor, gbuffer);
  if (visibility) std::visit([&](const auto& v) { check_visibility(v, gbuffer, lights); }, *visibility);
  return method.run(gbuffer, lights, visibility, params, device, report);
}

}  // namespace vsgl
