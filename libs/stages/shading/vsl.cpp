#include <algorithm>
#include <cstdint>

#include "base/error.h"
#include "math/progressive.h"
#include "spirv/shading/vsl.comp.glsl.h"  // after <cstdint>, which it needs
#include "stages/shading/light_pack.h"
#include "stages/shading/methods.h"
#include "stages/shading/pass.h"

namespace vsgl {
namespace {

// Directions of one dispatch at most: a second or so on the slowest devices, which would be reset for longer
// ones.
constexpr std::size_t kDispatchDirections = std::size_t{1} << 27;
constexpr std::size_t kTechniques = 3;

std::uint32_t techniques_of(const std::string& name) {
  if (name == "all") return interop::VSL_CONE | interop::VSL_RECEIVER | interop::VSL_LIGHT;
  if (name == "cone") return interop::VSL_CONE;
  if (name == "receiver") return interop::VSL_RECEIVER;
  if (name == "light") return interop::VSL_LIGHT;
  throw Error(ErrorCode::bad_value, "vsl_techniques: \"" + name + "\" is none of all, cone, receiver, light");
}

bool is_sphere(const std::string& cone) {
  if (cone != "disk" && cone != "sphere")
    throw Error(ErrorCode::bad_value, "vsl_cone: \"" + cone + "\" is none of disk, sphere");
  return cone == "sphere";
}

}  // namespace

Indirect shade_vsl(const GBuffer& gbuffer, const Lights& lights, const Visibility* visibility,
                   const ShadingParams& params, gpu::Device& device, Report& report) {
  const std::uint64_t seed = pass_seed(params.seed, params.pass);
  const auto samples = static_cast<std::uint32_t>(params.vsl_samples);
  ShadingKernel kernel;
  kernel.spirv = vsl_comp_spv;
  kernel.lights = pack_points(lights);
  kernel.vsl = {.samples = samples,
                .techniques = techniques_of(params.vsl_techniques),
                .sphere = is_sphere(params.vsl_cone),
                .seed = static_cast<std::uint32_t>(seed ^ seed >> 32)};
  kernel.pixels = 1;
  kernel.receivers = std::max<std::size_t>(
      interop::SHADING_GROUP, kDispatchDirections / (interop::SHADING_BLOCK_LIGHTS * kTechniques * samples));
  return compose(gbuffer, run_shading(gbuffer, visibility, kernel, params, device, report), !params.skip);
}

}  // namespace vsgl
