#include "stages/visibility/rays.h"

#include <optional>

#include "stages/visibility/cut_visibility.h"
#include "stages/visibility/ray_sight.h"

namespace vsgl::visibility {

Visibility trace_cut(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device*,
                     Report& report) {
  std::optional<trace::Tracer> tracer;
  std::vector<interop::vec3> normals;
  {
    const PhaseTimer timer(report, "build");
    tracer.emplace(inputs.scene);
    normals = representative_normals(inputs.lights, *tracer);
  }
  const PhaseTimer timer(report, "rays");
  const RaySight sight(*inputs.gbuffer, inputs.lights, normals, *tracer);
  return find_cut_visibility(*inputs.gbuffer, inputs.lights, inputs.cut, sight, params, report);
}

}  // namespace vsgl::visibility
