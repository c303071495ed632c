#include "stages/shading/pass.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "interop/model.h"
#include "stages/shading/receivers.h"
#include "stages/shading/visibility_buffers.h"

namespace vsgl {
namespace {

using interop::ShadingLight;
using interop::ShadingSums;

constexpr const char* kPhase = "shade";
constexpr std::array<const char*, interop::NDF_ANY + 1> kNdfNames = {"diffuse", "ggx", "beckmann", "phong",
                                                                     "general"};

// Lights that one pipeline serves, in the order of the artifact.
struct LightList {
  std::uint32_t ndf = interop::NDF_NONE;
  std::vector<ShadingLight> lights;
};

std::vector<LightList> sort_lights(const std::vector<ShadingLight>& lights, bool skip) {
  std::array<LightList, interop::NDF_ANY + 1> lists;
  for (const ShadingLight& light : lights) {
    const std::uint32_t ndf = skip ? light.ndf : interop::NDF_ANY;
    lists[ndf].ndf = ndf;
    lists[ndf].lights.push_back(light);
  }
  std::vector<LightList> out;
  for (LightList& list : lists)
    if (!list.lights.empty()) out.push_back(std::move(list));
  return out;
}

// The more, the fewer loads of lights, but the longer the compilation of the unrolled loop.
std::uint32_t pixels_per_invocation(std::uint32_t receiver, std::uint32_t emission) {
  if (receiver == interop::NDF_ANY) return 1;
  return receiver == interop::NDF_NONE && emission == interop::NDF_NONE ? 8 : 4;
}

void report_classes(const GBuffer& gbuffer, const std::vector<ReceiverList>& receivers,
                    const std::vector<LightList>& lights, const Visibility* visibility,
                    const ShadingKernel& kernel, Report& report) {
  std::size_t seen = 0;
  for (const ReceiverList& list : receivers) {
    report.count(std::string("pixels_") + kNdfNames[list.ndf], list.pixels.size());
    seen += list.pixels.size();
    if (!list.bumped)
      report.skipped("geometric horizon", std::string(kNdfNames[list.ndf]) + " pixels have no normal map");
  }
  for (const LightList& list : lights)
    report.count(std::string("lights_") + kNdfNames[list.ndf], list.lights.size());
  report.count("evaluations", seen * kernel.lights.size());
  if (seen < gbuffer.pixels.size())
    report.skipped("background", std::to_string(gbuffer.pixels.size() - seen) + " pixels see nothing");
  if (!kernel.skip) return;
  const auto is_diffuse = [](const auto& list) { return list.ndf == interop::NDF_NONE; };
  if (std::all_of(receivers.begin(), receivers.end(), is_diffuse))
    report.skipped("specular reflection", "no pixel has a specular lobe");
  if (std::all_of(lights.begin(), lights.end(), is_diffuse))
    report.skipped("specular emission", "no light has a specular lobe");
  if (!visibility) report.skipped("visibility", "none given");
}

// The device's side of one run.
class Pass {
 public:
  Pass(const GBuffer& gbuffer, const Visibility* visibility, const ShadingKernel& kernel, gpu::Device& device)
      : kernel_(kernel), device_(device), visibility_(visibility, device) {
    push_.camera = {static_cast<float>(gbuffer.camera.x), static_cast<float>(gbuffer.camera.y),
                    static_cast<float>(gbuffer.camera.z)};
    push_.cancel_scale = kernel.threshold > 0 ? 2 / kernel.threshold : 0;
    push_.clamp_distance2 = kernel.clamp_distance2;
    visibility_.describe(push_);
  }

  // Sums of the pixels of `receivers` over all lights, in the fixed order of the lists.
  std::vector<ShadingSums> run(const ReceiverList& receivers, const std::vector<LightList>& lights,
                               Report& report) {
    gpu::Buffer surfaces = gpu::Buffer::from(device_, receivers.surfaces);
    gpu::Buffer results(device_, receivers.surfaces.size() * sizeof(ShadingSums));
    results.clear();
    for (const LightList& list : lights) {
      const std::uint32_t pixels = pixels_per_invocation(receivers.ndf, list.ndf);
      const gpu::ComputePipeline pipeline = build(receivers, list, pixels);
      std::span<const ShadingLight> rest = list.lights;
      while (!rest.empty()) {
        const auto block =
            visibility_.leading(rest.first(std::min(block_lights(), rest.size())), receivers.pixels.size());
        dispatch(pipeline, surfaces, block, receivers, results, pixels, report);
        rest = rest.subspan(block.size());
      }
    }
    return results.download<ShadingSums>(receivers.surfaces.size());
  }

 private:
  std::size_t block_lights() const {
    return std::min<std::size_t>(interop::SHADING_BLOCK_LIGHTS,
                                 device_.limits().maxUniformBufferRange / sizeof(ShadingLight));
  }
  // The whole block is bound, so that the shader's array is backed even where it is not read.
  gpu::Buffer upload_block(std::span<const ShadingLight> lights) const {
    std::vector<ShadingLight> padded(lights.begin(), lights.end());
    padded.resize(block_lights());
    return gpu::Buffer::from(device_, padded);
  }

  gpu::ComputePipeline build(const ReceiverList& receivers, const LightList& lights,
                             std::uint32_t pixels) const {
    using gpu::Binding;
    return gpu::ComputePipeline(device_, kernel_.spirv,
                                {Binding::storage, Binding::uniform, Binding::storage, Binding::storage,
                                 Binding::storage, Binding::storage},
                                sizeof(push_),
                                {{interop::SHADING_RECEIVER_ID, receivers.ndf},
                                 {interop::SHADING_EMISSION_ID, lights.ndf},
                                 {interop::SHADING_SHADOWS_ID, visibility_.kind()},
                                 {interop::SHADING_CANCEL_ID, kernel_.threshold > 0},
                                 {interop::SHADING_BUMPED_ID, receivers.bumped},
                                 {interop::SHADING_ASG_ID, kernel_.asg},
                                 {interop::SHADING_PIXELS_ID, pixels}});
  }

  void dispatch(const gpu::ComputePipeline& pipeline, gpu::Buffer& surfaces,
                std::span<const ShadingLight> lights, const ReceiverList& receivers, gpu::Buffer& results,
                std::uint32_t pixels, Report& report) {
    const std::size_t count = receivers.pixels.size();
    push_.receivers = static_cast<std::uint32_t>(count);
    push_.lights = static_cast<std::uint32_t>(lights.size());
    visibility_.locate(lights, push_);
    gpu::Buffer block = upload_block(lights);
    gpu::Buffer bits = visibility_.bits(lights, receivers.pixels);
    gpu::Commands commands(device_);
    commands.dispatch(kPhase, pipeline,
                      {surfaces, block, results, visibility_.maps(lights), visibility_.views(), bits}, push_,
                      {gpu::groups_for(count, interop::SHADING_GROUP * pixels), 1, 1});
    commands.submit(report);
  }

  const ShadingKernel& kernel_;
  gpu::Device& device_;
  VisibilityBuffers visibility_;
  interop::ShadingPush push_;
};

interop::vec3 product(interop::vec3 a, interop::vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
double luminance(interop::vec3 c) {
  return vsgl::luminance(Vec3{c.x, c.y, c.z});
}

}  // namespace

std::vector<ShadingSums> run_shading(const GBuffer& gbuffer, const Visibility* visibility,
                                     const ShadingKernel& kernel, gpu::Device& device, Report& report) {
  const std::vector<ReceiverList> receivers = sort_receivers(gbuffer, kernel.skip);
  const std::vector<LightList> lights = sort_lights(kernel.lights, kernel.skip);
  report_classes(gbuffer, receivers, lights, visibility, kernel, report);
  PhaseTimer timer(report, kPhase);
  Pass pass(gbuffer, visibility, kernel, device);
  std::vector<ShadingSums> image(gbuffer.pixels.size());
  for (const ReceiverList& list : receivers) {
    const std::vector<ShadingSums> sums = pass.run(list, lights, report);
    for (std::size_t i = 0; i < sums.size(); ++i) image[list.pixels[i]] = sums[i];
  }
  return image;
}

Indirect compose(const GBuffer& gbuffer, const std::vector<ShadingSums>& sums, bool all) {
  Indirect out;
  out.width = gbuffer.width;
  out.height = gbuffer.height;
  const bool specular = all || gbuffer.has_specular();
  for (std::size_t i = 0; i < sums.size(); ++i) {
    out.diffuse.push_back(product(gbuffer.pixels[i].diffuse, sums[i].diffuse));
    if (specular) out.specular.push_back(product(gbuffer.pixels[i].specular, sums[i].specular));
  }
  return out;
}

double pixel_luminance(const Indirect& image, std::size_t pixel) {
  return luminance(image.diffuse[pixel]) + (image.specular.empty() ? 0 : luminance(image.specular[pixel]));
}

namespace {

// Share of each pixel's luminance that came from cancelled lights, 0..1.
std::vector<float> cancelled_share(const Indirect& indirect, const std::vector<ShadingSums>& sums) {
  std::vector<float> share(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double total = pixel_luminance(indirect, i);
    share[i] =
        total > 0 ? static_cast<float>(std::min(static_cast<double>(sums[i].aside) / total, 1.0)) : 0.0f;
  }
  return share;
}

}  // namespace

Indirect shade_sg(ShadingKernel kernel, const GBuffer& gbuffer, const Visibility* visibility,
                  const ShadingParams& params, gpu::Device& device, Report& report) {
  kernel.threshold = static_cast<float>(params.cbr);
  kernel.asg = params.specular_lobe == "asg";
  kernel.skip = params.skip;
  const auto sums = run_shading(gbuffer, visibility, kernel, device, report);
  Indirect out = compose(gbuffer, sums, !params.skip);
  if (params.cbr > 0) out.cancellation = cancelled_share(out, sums);
  return out;
}

}  // namespace vsgl
