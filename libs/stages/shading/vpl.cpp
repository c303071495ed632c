#include <cmath>
#include <cstdint>

#include "math/progressive.h"
#include "spirv/shading/vpl.comp.glsl.h"  // after <cstdint>, which it needs
#include "stages/shading/light_pack.h"
#include "stages/shading/methods.h"
#include "stages/shading/pass.h"

namespace vsgl {
namespace {

// Share of the image's luminance that the distance floor took away.
double clamped_fraction(const Indirect& image, const std::vector<interop::ShadingSums>& sums) {
  double kept = 0, lost = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    kept += pixel_luminance(image, i);
    lost += static_cast<double>(sums[i].aside);
  }
  return kept + lost > 0 ? lost / (kept + lost) : 0;
}

}  // namespace

Indirect shade_vpl(const GBuffer& gbuffer, const Lights& lights, const Visibility* visibility,
                   const ShadingParams& params, gpu::Device& device, Report& report) {
  const double floor = params.clamp * gbuffer.scene_radius * std::sqrt(radius2_scale(params.pass));
  ShadingKernel kernel;
  kernel.spirv = vpl_comp_spv;
  kernel.lights = pack_points(lights);
  kernel.clamp_distance2 = static_cast<float>(floor * floor);
  const auto sums = run_shading(gbuffer, visibility, kernel, params, device, report);
  Indirect out = compose(gbuffer, sums, !params.skip);
  report.count("clamp_distance_m", floor);
  report.count("clamped_fraction", clamped_fraction(out, sums));
  return out;
}

}  // namespace vsgl
