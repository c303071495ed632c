#include "stages/visibility/map_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/error.h"
#include "spirv/visibility/fill.comp.glsl.h"
#include "spirv/visibility/pull.comp.glsl.h"
#include "spirv/visibility/push.comp.glsl.h"
#include "stages/visibility/views.h"

namespace vsgl::visibility {
namespace {

using gpu::Binding;

constexpr std::uint32_t group_size = 64;  // of every shader of pull-push

struct Pipelines {
  gpu::ComputePipeline pull, push, fill;

  explicit Pipelines(gpu::Device& device)
      : pull(device, pull_comp_spv, {Binding::storage, Binding::storage}, sizeof(interop::SplatPush)),
        push(device, push_comp_spv, {Binding::storage, Binding::storage}, sizeof(interop::SplatPush)),
        fill(device, fill_comp_spv, {Binding::storage, Binding::storage, Binding::storage},
             sizeof(interop::SplatPush)) {}
};

// A light that gets a map: its view and where its tile goes.
struct MapJob {
  std::size_t light;
  interop::SplatView view;
};

struct FillCounts {
  std::uint64_t filled = 0, replaced = 0;
};

// 64 MiB: half of what every device lets a shader see of a buffer.
constexpr std::size_t max_batch_texels = std::size_t{1} << 24;
// Devices take at least 65535 groups in one dimension.
constexpr std::size_t max_batch_views = 32768;

std::size_t texels_of(int tile) {
  return static_cast<std::size_t>(tile) * static_cast<std::size_t>(tile);
}

void check_atlas(const Lights& lights, const VisibilityParams& params) {
  constexpr std::size_t max_atlas_texels = std::size_t{1} << 28;
  if (lights.lights.size() * texels_of(params.tile) <= max_atlas_texels) return;
  throw Error(ErrorCode::out_of_range,
              "tile: " + std::to_string(lights.lights.size()) + " maps of " + std::to_string(params.tile) +
                  " texels a side need more than 2^28 texels; use smaller tiles or fewer lights");
}

ShadowMaps empty_atlas(const Lights& lights, const VisibilityParams& params, double disk_radius) {
  ShadowMaps maps;
  maps.tile = params.tile;
  maps.columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(lights.lights.size()))));
  maps.anchor = lights.anchor;
  maps.bias_disk_radius = disk_radius;
  maps.views.resize(lights.lights.size());
  maps.inverse_distance.assign(
      static_cast<std::size_t>(maps.columns) * static_cast<std::size_t>(maps.rows()) * texels_of(maps.tile),
      0);
  return maps;
}

// Views of all lights into `maps`; jobs for those with power (or for all).
std::vector<MapJob> plan_views(const Lights& lights, const VisibilityParams& params,
                               const PointSource& points, ShadowMaps& maps, Report& report) {
  std::vector<MapJob> jobs;
  std::size_t curved = 0, off_centre = 0;
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const auto& light = lights.lights[i];
    auto view = make_view(light, lights.scene_radius, points.disk_radius());
    view.first_point = points.first_point(i);
    maps.views[i] = {view.origin, view.axis};
    if (params.skip_powerless && !has_power(light)) continue;
    jobs.push_back({i, view});
    curved += is_curved(light);
    off_centre += is_off_centre(light);
  }
  const std::size_t skipped = lights.lights.size() - jobs.size();
  if (skipped > 0) report.skipped(std::to_string(skipped) + " shadow maps", "their lights have no power");
  report.count("maps", jobs.size());
  report.count("curved_clusters", curved);
  report.count("off_centre_origins", off_centre);
  return jobs;
}

// Copies the tiles of a batch, one after another in `tiles`, to their places in the atlas.
void place_tiles(std::span<const MapJob> batch, std::span<const float> tiles, ShadowMaps& maps) {
  const auto tile = static_cast<std::size_t>(maps.tile), columns = static_cast<std::size_t>(maps.columns);
#pragma omp parallel for schedule(static)
  for (std::size_t j = 0; j < batch.size(); ++j) {
    const std::size_t row = batch[j].light / columns, column = batch[j].light % columns;
    for (std::size_t y = 0; y < tile; ++y) {
      const float* from = tiles.data() + (j * tile + y) * tile;
      std::copy_n(from, tile, maps.inverse_distance.data() + ((row * tile + y) * columns + column) * tile);
    }
  }
}

interop::SplatPush push_constants(const VisibilityParams& params, const PointSource& points,
                                  std::size_t view_count) {
  interop::SplatPush push{};
  push.tile = static_cast<std::uint32_t>(params.tile);
  push.view_count = static_cast<std::uint32_t>(view_count);
  push.disk_radius = static_cast<float>(points.disk_radius());
  push.splat_scale = static_cast<float>(params.splat_scale);
  return push;
}

// Closes the holes of `view_count` maps.
void record_pull_push(gpu::Commands& commands, const Pipelines& pipelines, interop::SplatPush push,
                      gpu::Buffer& maps, gpu::Buffer& levels, gpu::Buffer& counts) {
  const auto groups = [&](std::uint32_t level) {
    return std::array<std::uint32_t, 3>{
        gpu::groups_for(texels_of(static_cast<int>(push.tile >> level)), group_size), push.view_count, 1};
  };
  for (push.level = 0; push.level < interop::PULL_PUSH_LEVELS; ++push.level)
    commands.dispatch("pull-push", pipelines.pull, {maps, levels}, push, groups(push.level + 1));
  for (push.level = interop::PULL_PUSH_LEVELS - 1; push.level > 0; --push.level)
    commands.dispatch("pull-push", pipelines.push, {maps, levels}, push, groups(push.level));
  commands.dispatch("pull-push", pipelines.fill, {maps, levels, counts}, push, groups(1));
}

// The maps of all jobs, a batch at a time so that device buffers stay below max_batch_texels.
FillCounts render_jobs(gpu::Device& device, PointSource& points, std::span<const MapJob> jobs,
                       const VisibilityParams& params, ShadowMaps& maps, Report& report) {
  const Pipelines pipelines(device);
  const std::size_t batch_size =
      std::min({jobs.size(), max_batch_views, max_batch_texels / texels_of(params.tile)});
  const std::size_t map_texels = batch_size * texels_of(params.tile);
  gpu::Buffer views(device, batch_size * sizeof(interop::SplatView));
  gpu::Buffer atlas(device, map_texels * sizeof(float));
  gpu::Buffer levels(device, params.pull_push ? map_texels / 3 * sizeof(float) : 0);
  gpu::Buffer counts(device, batch_size * sizeof(interop::uvec2));
  FillCounts total;
  for (std::size_t first = 0; first < jobs.size(); first += batch_size) {
    const auto batch = jobs.subspan(first, std::min(batch_size, jobs.size() - first));
    std::vector<interop::SplatView> batch_views;
    for (const auto& job : batch) batch_views.push_back(job.view);
    views.write(0, std::as_bytes(std::span<const interop::SplatView>(batch_views)));
    atlas.clear();
    counts.clear();
    const auto push = push_constants(params, points, batch.size());
    gpu::Commands commands(device);
    points.splat(commands, views, atlas, push);
    if (params.pull_push) record_pull_push(commands, pipelines, push, atlas, levels, counts);
    commands.submit(report);
    place_tiles(batch, atlas.download<float>(batch.size() * texels_of(params.tile)), maps);
    for (const auto& count : counts.download<interop::uvec2>(batch.size())) {
      total.filled += count.x;
      total.replaced += count.y;
    }
  }
  return total;
}

}  // namespace

ShadowMaps render_maps(const Lights& lights, const VisibilityParams& params, gpu::Device& device,
                       const std::function<std::unique_ptr<PointSource>()>& make_points, Report& report) {
  check_atlas(lights, params);
  if (lights.lights.empty()) {
    report.skipped("all shadow maps", "there are no lights");
    return empty_atlas(lights, params, 0);
  }
  std::unique_ptr<PointSource> points;
  {
    const PhaseTimer timer(report, "points");
    points = make_points();
  }
  ShadowMaps maps = empty_atlas(lights, params, points->disk_radius());
  const auto jobs = plan_views(lights, params, *points, maps, report);
  if (jobs.empty()) return maps;
  const PhaseTimer timer(report, "maps");
  const auto counts = render_jobs(device, *points, jobs, params, maps, report);
  const auto texels = static_cast<double>(jobs.size() * texels_of(params.tile));
  if (params.pull_push) {
    report.count("filled_fraction", static_cast<double>(counts.filled) / texels);
    report.count("replaced_fraction", static_cast<double>(counts.replaced) / texels);
  }
  return maps;
}

}  // namespace vsgl::visibility
