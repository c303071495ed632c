#pragma once

#include "gpu/buffer.h"
#include "interop/interop.h"

namespace vsgl::gpu {

// The buffer's device address as its low and high word, for GLSL's buffer_reference_uvec2.
inline interop::uvec2 address_of(const Buffer& buffer) {
  const VkDeviceAddress address = buffer.address();
  return {static_cast<interop::uint>(address), static_cast<interop::uint>(address >> 32)};
}

}  // namespace vsgl::gpu
