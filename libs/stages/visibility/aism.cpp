#include "stages/visibility/aism.h"

#include "math/subdivision.h"
#include "stages/visibility/pool_source.h"
#include "stages/visibility/view_importance.h"

namespace vsgl::visibility {
namespace {

// Patches are cut to this share of the scene's area, so that the density may vary within large triangles.
constexpr double kLargestPatch = 1.0 / 16384;

double total_area(const scene::Scene& scene) {
  double area = 0;
  for (const Patch& triangle : make_patches(scene)) area += triangle.area;
  return area;
}

std::vector<Vec3> centres_of(const scene::Scene& scene, const std::vector<Patch>& patches) {
  std::vector<Vec3> centres;
  centres.reserve(patches.size());
  for (const Patch& patch : patches) {
    const Corners corners = corners_of(scene, patch.instance, patch.first_index);
    const Vec3 w = subdivision_point(patch.side, patch.cell, {1.0 / 3, 1.0 / 3});
    centres.push_back(w.x * position_of(*corners[0]) + w.y * position_of(*corners[1]) +
                      w.z * position_of(*corners[2]));
  }
  return centres;
}

}  // namespace

Visibility build_aism(const VisibilityInputs& inputs, const VisibilityParams& params, gpu::Device* device,
                      Report& report) {
  const scene::Scene& scene = inputs.scene;
  const auto make_points = [&] {
    const std::vector<Patch> patches = make_patches(scene, kLargestPatch * total_area(scene));
    const ViewImportance importance = view_importance(centres_of(scene, patches), areas_of(patches),
                                                      inputs.lights, *inputs.gbuffer, params.seed);
    report.count("patches", patches.size());
    report.count("view_pairs", importance.pairs);
    if (importance.pairs == 0)
      report.skipped("adapting points to the view", "no pair of a light and a pixel faces each other");
    return make_pool_source(sample_points(scene, patches, importance.weights, inputs.lights.lights.size(),
                                          params.points_per_light, params.seed),
                            params.points_per_light, *device, report);
  };
  return render_maps(inputs.lights, params, *device, make_points, report);
}

}  // namespace vsgl::visibility
