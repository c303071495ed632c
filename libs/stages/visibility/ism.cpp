#include "stages/visibility/ism.h"

#include "stages/visibility/pool_source.h"

namespace vsgl::visibility {

ShadowMaps render_shadow_maps(const scene::Scene& scene, const Lights& lights, const VisibilityParams& params,
                              gpu::Device& device, Report& report) {
  const auto make_points = [&] {
    const std::vector<Patch> patches = make_patches(scene);
    return make_pool_source(sample_points(scene, patches, areas_of(patches), lights.lights.size(),
                                          params.points_per_light, params.seed),
                            params.points_per_light, device, report);
  };
  return render_maps(lights, params, device, make_points, report);
}

Visibility build_ism(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device* device,
                     Report& report) {
  return render_shadow_maps(inputs.scene, inputs.lights, params, *device, report);
}

}  // namespace vsgl::visibility
