#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/device.h"

namespace vsgl::gpu {

// Offscreen images to draw into: colour attachments of the given formats and a 32-bit float depth. Throws
// device_limit when the device cannot draw images of that size, or runs 512 bits wide
// (DeviceOptions::compute_only).
class RasterTarget {
 public:
  RasterTarget(Device& device, std::uint32_t width, std::uint32_t height, std::vector<VkFormat> colours);
  ~RasterTarget();
  RasterTarget(const RasterTarget&) = delete;
  RasterTarget& operator=(const RasterTarget&) = delete;

  // Copies a colour attachment into a buffer, row after row from the top.
  void read(std::size_t colour, Buffer& buffer);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  const std::vector<VkFormat>& formats() const { return formats_; }

 private:
  friend class RasterPipeline;
  struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
  };
  void create(Image& image, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect);
  void release();

  Device& device_;
  std::uint32_t width_, height_;
  std::vector<VkFormat> formats_;
  std::vector<Image> colours_;
  Image depth_;
};

// A vertex and a fragment shader that draw triangles without vertex buffers or descriptors: they fetch what
// they need by address (GLSL's buffer_reference) from push constants. Both faces are drawn. Depth is reversed
// (0 is far) and tested with GREATER, so that of equal depths the first drawn wins. A handle, as
// ComputePipeline.
class RasterPipeline {
 public:
  RasterPipeline(Device& device, std::span<const std::uint32_t> vertex_spirv,
                 std::span<const std::uint32_t> fragment_spirv, std::vector<VkFormat> colours,
                 std::size_t push_bytes);

  // Clears all attachments to 0, draws `vertices` vertices and waits.
  void draw(RasterTarget& target, std::uint32_t vertices, std::span<const std::byte> push) const;

 private:
  struct Impl;
  void record(VkCommandBuffer commands, RasterTarget& target, std::uint32_t vertices,
              std::span<const std::byte> push) const;

  Device& device_;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace vsgl::gpu
