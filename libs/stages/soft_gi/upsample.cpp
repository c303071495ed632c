#include "stages/soft_gi/upsample.h"

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "math/interop_vec.h"
#include "spirv/proxy/upsample.comp.glsl.h"

namespace vsgl::soft_gi {
namespace {

using gpu::Binding, gpu::Buffer, gpu::groups_for;

constexpr std::uint32_t kGroup = 8;
constexpr float kLeastWeight = 1e-3f;  // below it no receiver suits

}  // namespace

Upsampled upsample(const GBuffer& gbuffer, const ReceiverGrid& grid, const ReceiverGroups& groups,
                   const std::vector<interop::ProxyShade>& shades, std::uint32_t method, gpu::Device& device,
                   Report& report) {
  std::vector<interop::ProxyReceiver> pixels;
  for (const interop::Surface& surface : gbuffer.pixels) pixels.push_back(receiver_of(surface));
  const auto width = static_cast<std::uint32_t>(gbuffer.width),
             height = static_cast<std::uint32_t>(gbuffer.height);
  const interop::ProxyUpsamplePush push{to_float(gbuffer.camera),
                                        width,
                                        height,
                                        static_cast<std::uint32_t>(grid.rate),
                                        static_cast<std::uint32_t>(grid.columns),
                                        static_cast<std::uint32_t>(grid.rows)};
  const gpu::ComputePipeline pipeline(device, upsample_comp_spv, std::vector<Binding>(5, Binding::storage),
                                      sizeof push, {{interop::PROXY_UPSAMPLE_ID, method}});
  Buffer pixel_buffer = Buffer::from(device, pixels), receivers = Buffer::from(device, groups.receivers);
  Buffer slots = Buffer::from(device, groups.slots), shade_buffer = Buffer::from(device, shades);
  Buffer results(device, pixels.size() * sizeof(interop::ProxyPixel));
  gpu::Commands commands(device);
  commands.dispatch("upsample", pipeline, {pixel_buffer, receivers, slots, shade_buffer, results}, push,
                    {groups_for(width, kGroup), groups_for(height, kGroup), 1});
  commands.submit(report);
  Upsampled out;
  const auto found = results.download<interop::ProxyPixel>(pixels.size());
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    out.shades.push_back(found[i].shade);
    if (pixels[i].seen != 0 && found[i].weight < kLeastWeight) out.unsuited.push_back(i);
  }
  return out;
}

}  // namespace vsgl::soft_gi
