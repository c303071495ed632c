#include "stages/visibility/pool_source.h"

#include "spirv/visibility/splat.comp.glsl.h"

namespace vsgl::visibility {
namespace {

using gpu::Binding;

class PoolSource final : public PointSource {
 public:
  PoolSource(const PointPool& pool, int points_per_light, gpu::Device& device)
      : disk_radius_(pool.disk_radius),
        size_(static_cast<std::uint32_t>(pool.points.size())),
        points_per_light_(static_cast<std::uint32_t>(points_per_light)),
        points_(gpu::Buffer::from(device, pool.points)),
        pipeline_(device, splat_comp_spv, {Binding::storage, Binding::storage, Binding::storage},
                  sizeof(interop::SplatPush)) {}

  double disk_radius() const override { return disk_radius_; }
  std::uint32_t first_point(std::size_t light) const override {
    return static_cast<std::uint32_t>(light * points_per_light_ % size_);
  }
  void splat(gpu::Commands& commands, gpu::Buffer& views, gpu::Buffer& maps,
             const interop::SplatPush& common) override {
    interop::SplatPush push = common;
    push.points_per_view = points_per_light_;
    push.pool_size = size_;
    commands.dispatch("splat", pipeline_, {views, maps, points_}, push, {push.view_count, 1, 1});
  }

 private:
  double disk_radius_;
  std::uint32_t size_, points_per_light_;
  gpu::Buffer points_;
  gpu::ComputePipeline pipeline_;
};

}  // namespace

std::unique_ptr<PointSource> make_pool_source(const PointPool& pool, int points_per_light,
                                              gpu::Device& device, Report& report) {
  report.count("points", pool.points.size());
  if (pool.holes > 0) report.count("points_in_holes", pool.holes);
  return std::make_unique<PoolSource>(pool, points_per_light, device);
}

}  // namespace vsgl::visibility
