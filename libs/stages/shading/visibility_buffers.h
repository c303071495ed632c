#pragma once

#include <cstdint>
#include <span>

#include "artifact/artifact.h"
#include "gpu/buffer.h"
#include "gpu/compute.h"
#include "gpu/device.h"
#include "interop/shading.h"

namespace vsgl {

// The device's side of a Visibility, which must outlive it. What belongs to many lights exceeds what a shader
// may see of a buffer: of the shadow maps, which lie on the device as a whole, it sees those of a block of
// lights, given by their indices; bits go there with each block.
class VisibilityBuffers {
 public:
  VisibilityBuffers(const Visibility* visibility, gpu::Device& device);

  std::uint32_t kind() const { return kind_; }  // VISIBILITY_* of interop/shading.h
  void describe(interop::ShadingPush& push) const;
  gpu::Buffer& views() { return views_; }

  // As many of `lights`, from the first on, as a shader may see the maps of, or the bits of so many
  // receivers; all of them without visibility. Throws device_limit when not even one row of maps, or the bits
  // of 32 lights, fits.
  std::span<const std::uint32_t> leading(std::span<const std::uint32_t> lights, std::size_t receivers) const;
  // The atlas from the first light's row of maps to the last light's.
  gpu::BufferRange maps(std::span<const std::uint32_t> lights);
  // Words from that of the first light to that of the last, each for all pixels of the list.
  gpu::Buffer bits(std::span<const std::uint32_t> lights, std::span<const std::uint32_t> pixels) const;
  // Sets where in `maps` and `bits` the lights are.
  void locate(std::span<const std::uint32_t> lights, interop::ShadingPush& push) const;

 private:
  std::size_t row_of(std::uint32_t light) const;  // of the atlas, in maps
  std::size_t row_bytes() const;

  gpu::Device& device_;
  std::uint32_t kind_;
  const ShadowMaps* maps_;
  const VisibilityBits* bits_;
  gpu::Buffer atlas_, views_;
};

}  // namespace vsgl
