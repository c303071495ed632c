#include "stages/visibility/tessellated.h"

#include "spirv/visibility/tessellate.comp.glsl.h"
#include "stages/visibility/cells.h"
#include "stages/visibility/map_renderer.h"

namespace vsgl::visibility {
namespace {

using gpu::Binding;

struct TessellatePush {
  interop::SplatPush splat;
  interop::CellPush cells;
};

class CellSource final : public PointSource {
 public:
  CellSource(const Cells& cells, std::uint64_t seed, gpu::Device& device)
      : disk_radius_(cells.disk_radius),
        points_per_light_(cells.points_per_light()),
        push_{static_cast<std::uint32_t>(cells.triangles.size()),
              cells.count,
              {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}},
        starts_(gpu::Buffer::from(device, cells.starts)),
        triangles_(gpu::Buffer::from(device, cells.triangles)),
        masks_(gpu::Buffer::from(device, cells.masks)),
        pipeline_(device, tessellate_comp_spv, std::vector(5, Binding::storage), sizeof(TessellatePush)) {}

  double disk_radius() const override { return disk_radius_; }
  // Its place in a row of CELLS_PER_POINT cells: an odd step near the golden section of it, so that no two of
  // as many lights take the same and successive ones lie apart.
  std::uint32_t first_point(std::size_t light) const override {
    return static_cast<std::uint32_t>(light * 633 % interop::CELLS_PER_POINT);
  }
  void splat(gpu::Commands& commands, gpu::Buffer& views, gpu::Buffer& maps,
             const interop::SplatPush& common) override {
    TessellatePush push{common, push_};
    push.splat.points_per_view = points_per_light_;
    commands.dispatch("splat", pipeline_, {views, maps, starts_, triangles_, masks_}, push,
                      {push.splat.view_count, 1, 1});
  }

 private:
  double disk_radius_;
  std::uint32_t points_per_light_;
  interop::CellPush push_;
  gpu::Buffer starts_, triangles_, masks_;
  gpu::ComputePipeline pipeline_;
};

}  // namespace

Visibility build_tessellated(const VisibilityInputs& inputs, const VisibilityParams& params,
                             gpu::Device* device, Report& report) {
  const auto make_points = [&] {
    const Cells cells = make_cells(inputs.scene, params.points_per_light);
    report.count("triangles", cells.triangles.size());
    report.count("points_per_light", cells.points_per_light());
    return std::make_unique<CellSource>(cells, params.seed, *device);
  };
  return render_maps(inputs.lights, params, *device, make_points, report);
}

}  // namespace vsgl::visibility
