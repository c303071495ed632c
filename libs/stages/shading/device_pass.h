#pragma once

// The device's side of shading: sums lights block by block, with one specialised pipeline for each pair of
// classes of pixels and lights that occurs.

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "stages/shading/pass.h"
#include "stages/shading/receivers.h"
#include "stages/shading/visibility_buffers.h"

namespace vsgl {

// Lights that one pipeline serves, in the order of the artifact.
struct LightList {
  std::uint32_t ndf = interop::NDF_NONE;  // of all of them; NDF_ANY without `skip`
  std::vector<std::uint32_t> lights;      // indices
};
std::vector<LightList> sort_lights(const PackedLights& lights, bool skip);

// Everything given must outlive it.
class DevicePass {
 public:
  DevicePass(const GBuffer& gbuffer, const Visibility* visibility, const ShadingKernel& kernel,
             gpu::Device& device);

  // Sums of the pixels of `receivers` over the lights, in the fixed order of the lists.
  std::vector<interop::ShadingSums> run(const ReceiverList& receivers, const std::vector<LightList>& lights,
                                        Report& report);

 private:
  std::vector<interop::ShadingSums> run_part(const ReceiverList& receivers,
                                             const std::vector<LightList>& lights, Report& report);
  std::size_t block_lights() const;
  gpu::Buffer upload_block(std::span<const std::uint32_t> lights) const;
  gpu::ComputePipeline build(const ReceiverList& receivers, std::uint32_t emission,
                             std::uint32_t pixels) const;
  void dispatch(const gpu::ComputePipeline& pipeline, gpu::Buffer& surfaces,
                std::span<const std::uint32_t> lights, const ReceiverList& receivers, gpu::Buffer& results,
                std::uint32_t pixels, Report& report);

  const ShadingKernel& kernel_;
  gpu::Device& device_;
  VisibilityBuffers visibility_;
  interop::ShadingPush push_{};
};

}  // namespace vsgl
