#pragma once

#include <cstdint>
#include <span>

#include "artifact/artifact.h"
#include "gpu/buffer.h"
#include "gpu/device.h"
#include "interop/shading.h"

namespace vsgl {

// The device's side of a Visibility, which must outlive it. Shadow maps lie on the device as a whole, bits go
// there with each block of lights: those of many lights exceed what a shader may see of a buffer.
class VisibilityBuffers {
 public:
  VisibilityBuffers(const Visibility* visibility, gpu::Device& device);

  std::uint32_t kind() const { return kind_; }  // VISIBILITY_* of interop/shading.h
  void describe(interop::ShadingPush& push) const;
  gpu::Buffer& atlas() { return atlas_; }
  gpu::Buffer& views() { return views_; }

  // As many of `lights`, from the first on, as bits of so many receivers fit into one buffer; all of them
  // without bits. Throws device_limit when not even those of 32 lights fit.
  std::span<const interop::ShadingLight> leading(std::span<const interop::ShadingLight> lights,
                                                 std::size_t receivers) const;
  // Words from that of the first light to that of the last, each for all pixels of the list.
  gpu::Buffer bits(std::span<const interop::ShadingLight> lights,
                   std::span<const std::uint32_t> pixels) const;

 private:
  gpu::Device& device_;
  std::uint32_t kind_;
  const ShadowMaps* maps_;
  const VisibilityBits* bits_;
  gpu::Buffer atlas_, views_;
};

}  // namespace vsgl
