#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "gpu/device.h"

namespace vsgl::gpu {

// A device buffer usable as storage, uniform (up to the device's limit), uniform texel and transfer buffer,
// and by address. Mapped on CPU and integrated devices (always on lavapipe), staged elsewhere. Size 0 is
// rounded up to 16 bytes; the contents are undefined until written. Throws memory when the device has too
// little.
class Buffer {
 public:
  Buffer(Device& device, std::size_t bytes);
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  template <class T>
  static Buffer from(Device& device, std::span<const T> values) {
    Buffer buffer(device, values.size_bytes());
    buffer.write(0, std::as_bytes(values));
    return buffer;
  }
  template <class T>
  static Buffer from(Device& device, const std::vector<T>& values) {
    return from(device, std::span<const T>(values));
  }
  template <class T>
  std::vector<T> download(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count);
    read(0, std::as_writable_bytes(std::span<T>(values)));
    return values;
  }

  void write(std::size_t offset, std::span<const std::byte> bytes);
  void read(std::size_t offset, std::span<std::byte> bytes);
  void clear();  // to zero bytes

  VkDeviceAddress address() const;  // for GLSL's buffer_reference
  VkBuffer handle() const { return buffer_; }
  std::size_t size() const { return size_; }

 private:
  void release();
  void require_inside(std::size_t offset, std::size_t bytes) const;

  Device* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::size_t size_ = 0;
  std::byte* mapped_ = nullptr;
};

}  // namespace vsgl::gpu
