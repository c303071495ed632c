#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "gpu/address.h"
#include "gpu/compute.h"
#include "gpu/raster.h"
#include "interop/geometry.h"
#include "interop/model.h"
#include "math/interop_vec.h"
#include "pyramid/moment_pyramid.h"
#include "spirv/rsm/moments.comp.glsl.h"
#include "spirv/rsm/surface.comp.glsl.h"
#include "spirv/rsm/visibility.frag.glsl.h"
#include "spirv/rsm/visibility.vert.glsl.h"
#include "stages/rsm/device_scene.h"
#include "stages/rsm/rsm.h"
#include "stages/rsm/views.h"
#include "stages/rsm/visible.h"

namespace vsgl {
namespace {

constexpr std::uint32_t kGroup = 8;  // side of a work group of every shader here
constexpr VkFormat kVisibilityFormat = VK_FORMAT_R32_UINT;

std::array<std::uint32_t, 3> groups_over(std::uint32_t width, std::uint32_t height) {
  return {gpu::groups_for(width, kGroup), gpu::groups_for(height, kGroup), 1};
}

bool is_lit(const interop::Surface& surface) {
  return surface.id != interop::NO_INSTANCE;
}

void report_layer(const RsmLayer& layer, std::uint32_t clamped, Report& report) {
  const interop::Moments& top = layer.pyramid.back();
  const double count = static_cast<double>(layer.surface.size());
  const double diffuse = luminance(to_double(top.power_diffuse)),
               specular = luminance(to_double(top.power_specular));
  const double reflected = diffuse + specular;
  report.count("layer " + layer.name,
               {{"lit_texels", std::count_if(layer.surface.begin(), layer.surface.end(), is_lit)},
                {"flux_w", to_array(count * to_double(top.flux))},
                {"reflected_luminance_w", count * reflected},
                {"specular_fraction", reflected > 0 ? specular / reflected : 0.0},
                {"clamped_texels", clamped}});
}

// Buffers and images for views of one size.
struct Frame {
  Frame(gpu::Device& device, std::uint32_t w, std::uint32_t h, std::uint32_t stride_, std::uint32_t rows_)
      : width(w),
        height(h),
        stride(stride_),
        rows(rows_),
        visibility(device, std::size_t{w} * h * sizeof(interop::uint)),
        surface(device, std::size_t{stride_} * rows_ * sizeof(interop::Surface)) {}

  std::uint32_t width, height, stride, rows;
  gpu::Buffer visibility, surface;
  std::optional<gpu::RasterTarget> target;  // made when something is drawn
};

}  // namespace

struct Baker::Impl {
  Impl(const scene::Scene& s, gpu::Device& d, Report& r, VisibleBy v);

  void report_scene();
  interop::Bake describe(const interop::View& view, const Frame& frame) const;
  // Finds the triangles that the view sees and appends the resolving of its surface points to the commands.
  void see(const interop::Bake& job, Frame& frame);
  void draw(Frame& frame);
  void trace(const interop::View& view, Frame& frame);
  std::vector<interop::Surface> download_surface(Frame& frame);
  RsmLayer layer(const LightView& light, const interop::View& view, Frame& frame,
                 const gpu::ComputePipeline& moments_pipeline, MomentPyramid& pyramid);

  const scene::Scene& scene;
  gpu::Device& device;
  Report& report;
  bool by_rays;
  DeviceScene geometry;
  std::optional<trace::Tracer> tracer;  // made when the first ray is traced
  gpu::ComputePipeline surface_pipeline;
  gpu::Commands commands;
  gpu::Buffer bake, clamped;
  interop::BakePush push;
};

namespace {

DeviceScene upload(const scene::Scene& scene, gpu::Device& device, Report& report) {
  const PhaseTimer timer(report, "upload");
  return DeviceScene(scene, device);
}

}  // namespace

Baker::Impl::Impl(const scene::Scene& s, gpu::Device& d, Report& r, VisibleBy v)
    : scene(s),
      device(d),
      report(r),
      by_rays(v == VisibleBy::rays || (v == VisibleBy::automatic && d.info().type == "cpu")),
      geometry(upload(s, d, r)),
      surface_pipeline(d, surface_comp_spv, {}, sizeof(interop::BakePush)),
      commands(d),
      bake(d, sizeof(interop::Bake)),
      clamped(d, sizeof(interop::uint)),
      push{address_of(bake)} {}

void Baker::Impl::report_scene() {
  report.count("triangles", geometry.triangle_count());
  report.count("instances", scene.instances.size());
  report.count("visible_by", by_rays ? "rays" : "raster");
}

interop::Bake Baker::Impl::describe(const interop::View& view, const Frame& frame) const {
  interop::Bake job{};
  job.geometry = geometry.geometry();
  job.view = view;
  job.visibility_at = address_of(frame.visibility);
  job.surface_at = address_of(frame.surface);
  job.clamped_at = address_of(clamped);
  job.stride = frame.stride;
  job.rows = frame.rows;
  return job;
}

void Baker::Impl::see(const interop::Bake& job, Frame& frame) {
  bake.write(0, std::as_bytes(std::span(&job, 1)));
  if (by_rays)
    trace(job.view, frame);
  else
    draw(frame);
  commands.dispatch("surface", surface_pipeline, {}, push, groups_over(frame.stride, frame.rows));
}

void Baker::Impl::draw(Frame& frame) {
  const PhaseTimer timer(report, "rasterise");
  const gpu::RasterPipeline pipeline(device, visibility_vert_spv, visibility_frag_spv, {kVisibilityFormat},
                                     sizeof push);
  if (!frame.target) frame.target.emplace(device, frame.width, frame.height, std::vector{kVisibilityFormat});
  pipeline.draw(*frame.target, 3 * geometry.triangle_count(), std::as_bytes(std::span(&push, 1)));
  frame.target->read(0, frame.visibility);
}

void Baker::Impl::trace(const interop::View& view, Frame& frame) {
  if (geometry.triangle_count() == 0) {
    frame.visibility.clear();
    return;
  }
  if (!tracer) {
    const PhaseTimer timer(report, "build hierarchy");
    tracer.emplace(scene);
  }
  const PhaseTimer timer(report, "trace");
  const std::vector<interop::uint> seen = trace_visible(scene, *tracer, view);
  frame.visibility.write(0, std::as_bytes(std::span(seen)));
}

std::vector<interop::Surface> Baker::Impl::download_surface(Frame& frame) {
  return frame.surface.download<interop::Surface>(std::size_t{frame.stride} * frame.rows);
}

RsmLayer Baker::Impl::layer(const LightView& light, const interop::View& view, Frame& frame,
                            const gpu::ComputePipeline& moments_pipeline, MomentPyramid& pyramid) {
  interop::Bake job = describe(view, frame);
  job.moments_at = address_of(pyramid.finest());
  clamped.clear();
  see(job, frame);
  commands.dispatch("moments", moments_pipeline, {}, push, groups_over(frame.stride, frame.rows));
  pyramid.merge(commands);
  {
    const PhaseTimer timer(report, "reflect");
    commands.submit(report);
  }
  const PhaseTimer timer(report, "download");
  RsmLayer out{light.name, light.light, download_surface(frame), pyramid.download()};
  report_layer(out, clamped.download<interop::uint>(1).front(), report);
  return out;
}

Baker::Baker(const scene::Scene& scene, gpu::Device& device, Report& report, VisibleBy visible)
    : impl_(std::make_unique<Impl>(scene, device, report, visible)) {}
Baker::~Baker() = default;

void Baker::update() {
  const PhaseTimer timer(impl_->report, "upload");
  impl_->geometry.update(impl_->scene);
  impl_->tracer.reset();
}

GBuffer Baker::gbuffer() {
  impl_->report_scene();
  const interop::View view = camera_view(impl_->scene.camera, impl_->scene.radius);
  GBuffer out;
  out.width = impl_->scene.camera.width;
  out.height = impl_->scene.camera.height;
  out.anchor = impl_->scene.anchor;
  out.camera = impl_->scene.camera.position;
  out.scene_radius = impl_->scene.radius;
  Frame frame(impl_->device, view.width, view.height, view.width, view.height);
  impl_->see(impl_->describe(view, frame), frame);
  impl_->commands.submit(impl_->report);
  out.pixels = impl_->download_surface(frame);
  impl_->report.count("seen_pixels", std::count_if(out.pixels.begin(), out.pixels.end(), is_lit));
  if (!out.has_specular())
    impl_->report.skipped("specular channels of the G-buffer", "no pixel has a specular lobe");
  return out;
}

Rsm Baker::rsm(const RsmParams& params) {
  if (std::min(params.width, params.height) < 1 || std::max(params.width, params.height) > kMaxRsmSize) {
    throw Error(ErrorCode::out_of_range, "RSM size " + std::to_string(params.width) + "x" +
                                             std::to_string(params.height) + ": must be 1 to " +
                                             std::to_string(kMaxRsmSize) + " a side");
  }
  impl_->report_scene();
  const std::vector<LightView> lights = light_views(impl_->scene);
  Rsm out;
  out.size = next_power_of_two(std::max(params.width, params.height));
  out.width = params.width;
  out.height = params.height;
  out.anchor = impl_->scene.anchor;
  out.scene_radius = impl_->scene.radius;
  const interop::uint consistent = params.normals == NormalConvention::consistent ? 1 : 0;
  const gpu::ComputePipeline moments_pipeline(impl_->device, moments_comp_spv, {}, sizeof(interop::BakePush),
                                              {{0, consistent}});
  const auto side = static_cast<std::uint32_t>(out.size);
  Frame frame(impl_->device, static_cast<std::uint32_t>(out.width), static_cast<std::uint32_t>(out.height),
              side, side);
  MomentPyramid pyramid(impl_->device, out.size);
  for (const LightView& light : lights) {
    const interop::View view = light_view(light.light, out.scene_radius, out.width, out.height);
    out.layers.push_back(impl_->layer(light, view, frame, moments_pipeline, pyramid));
  }
  if (!out.has_specular())
    impl_->report.skipped("specular channels of the RSM", "no texel has a specular lobe");
  return out;
}

}  // namespace vsgl
