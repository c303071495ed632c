#pragma once

#include "gpu/buffer.h"
#include "interop/interop.h"

namespace vsgl::gpu {

// The device address of the buffer's byte `offset` as its low and high word, for GLSL's
// buffer_reference_uvec2.
inline interop::uvec2 address_of(const Buffer& buffer, std::size_t offset = 0) {
  const VkDeviceAddress address = buffer.address() + offset;
  return {static_cast<interop::uint>(address), static_cast<interop::uint>(address >> 32)};
}

}  // namespace vsgl::gpu
