#pragma once

#include <vector>

#include "base/report.h"
#include "gpu/device.h"
#include "stages/soft_gi/receivers.h"

namespace vsgl::soft_gi {

// Of each pixel of the G-buffer.
struct Upsampled {
  std::vector<interop::ProxyShade> shades;
  std::vector<std::uint32_t> unsuited;  // pixels whose receivers all lie elsewhere
};

// `method`: interop::PROXY_PLANE, ...
Upsampled upsample(const GBuffer& gbuffer, const ReceiverGrid& grid, const ReceiverGroups& groups,
                   const std::vector<interop::ProxyShade>& shades, std::uint32_t method, gpu::Device& device,
                   Report& report);

}  // namespace vsgl::soft_gi
