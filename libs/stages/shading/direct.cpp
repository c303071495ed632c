#include <cstdint>

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "interop/shading.h"
#include "math/interop_vec.h"
#include "math/light_view.h"
#include "spirv/shading/direct.comp.glsl.h"  // after <cstdint>, which it needs
#include "stages/shading/methods.h"
#include "stages/shading/receivers.h"
#include "stages/shading/shading.h"

namespace vsgl {
namespace {

constexpr const char* kPhase = "direct";

interop::DirectPush make_push(const GBuffer& gbuffer, const Rsm& rsm, const LightSource& light) {
  interop::DirectPush push{};
  push.view = light_view(light, rsm.width, rsm.height);
  push.view.near_far = 1;  // only x and y of the clip coordinates are used
  push.camera = to_float(gbuffer.camera);
  push.stride = static_cast<interop::uint>(rsm.size);
  return push;
}

std::vector<gpu::Buffer> upload_depths(const Rsm& rsm, gpu::Device& device) {
  std::vector<gpu::Buffer> buffers;
  for (const RsmLayer& layer : rsm.layers) {
    std::vector<float> depths;
    depths.reserve(layer.surface.size());
    for (const interop::Surface& s : layer.surface)
      depths.push_back(s.id == interop::NO_INSTANCE ? 0.0f : s.depth);
    buffers.push_back(gpu::Buffer::from(device, depths));
  }
  return buffers;
}

}  // namespace

void shade_direct(const GBuffer& gbuffer, const Rsm& rsm, gpu::Device& device, Report& report,
                  Indirect& out) {
  require_same_anchor("RSM", rsm.anchor, gbuffer);
  PhaseTimer timer(report, kPhase);
  std::vector<gpu::Buffer> depths = upload_depths(rsm, device);
  out.direct.assign(gbuffer.pixels.size(), {});
  for (const ReceiverList& list : sort_receivers(gbuffer, true)) {
    using gpu::Binding;
    const gpu::ComputePipeline pipeline(
        device, direct_comp_spv, {Binding::storage, Binding::storage, Binding::storage},
        sizeof(interop::DirectPush),
        {{interop::SHADING_RECEIVER_ID, list.ndf}, {interop::SHADING_BUMPED_ID, list.bumped}});
    gpu::Buffer surfaces = gpu::Buffer::from(device, list.surfaces);
    gpu::Buffer radiance(device, list.pixels.size() * sizeof(interop::vec3));
    radiance.clear();
    gpu::Commands commands(device);
    for (std::size_t i = 0; i < rsm.layers.size(); ++i) {
      interop::DirectPush push = make_push(gbuffer, rsm, rsm.layers[i].light);
      push.receivers = static_cast<interop::uint>(list.pixels.size());
      commands.dispatch(kPhase, pipeline, {surfaces, depths[i], radiance}, push,
                        {gpu::groups_for(list.pixels.size(), interop::SHADING_GROUP), 1, 1});
    }
    commands.submit(report);
    const auto values = radiance.download<interop::vec3>(list.pixels.size());
    for (std::size_t i = 0; i < values.size(); ++i) out.direct[list.pixels[i]] = values[i];
  }
}

}  // namespace vsgl
