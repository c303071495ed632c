#include "gpu/buffer.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "base/error.h"
#include "gpu/vk_struct.h"

namespace vsgl::gpu {
namespace {

constexpr VkBufferUsageFlags kUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
    VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
constexpr VkMemoryPropertyFlags kMappable =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr std::size_t kStagingBytes = std::size_t{64} << 20;

VkBuffer create_buffer(VkDevice device, std::size_t bytes) {
  auto info = vk_struct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = kUsage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(device, &info, nullptr, &buffer), "vkCreateBuffer");
  return buffer;
}

// Memory of the first of `wanted` that the device has for this buffer.
VkDeviceMemory allocate(Device& device, VkBuffer buffer,
                        std::initializer_list<VkMemoryPropertyFlags> wanted) {
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.handle(), buffer, &needs);
  int type = -1;
  for (VkMemoryPropertyFlags flags : wanted) {
    if (type < 0) type = device.memory_type(needs.memoryTypeBits, flags);
  }
  if (type < 0)
    throw Error(ErrorCode::device_limit, "device \"" + device.info().name + "\": no memory for buffers");
  auto flags = vk_struct<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  auto info = vk_struct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags);
  info.allocationSize = needs.size;
  info.memoryTypeIndex = static_cast<std::uint32_t>(type);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device.handle(), &info, nullptr, &memory), "vkAllocateMemory");
  return memory;
}

// Host-visible memory through which buffers of discrete devices are read and written.
class Staging {
 public:
  Staging(Device& device, std::size_t bytes)
      : device_(device.handle()), buffer_(create_buffer(device_, bytes)) {
    memory_ = allocate(device, buffer_, {kMappable | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kMappable});
    check(vkBindBufferMemory(device_, buffer_, memory_, 0), "vkBindBufferMemory");
    check(vkMapMemory(device_, memory_, 0, VK_WHOLE_SIZE, 0, &mapped_), "vkMapMemory");
  }
  ~Staging() {
    vkDestroyBuffer(device_, buffer_, nullptr);
    vkFreeMemory(device_, memory_, nullptr);
  }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  VkBuffer handle() const { return buffer_; }
  void* data() const { return mapped_; }

 private:
  VkDevice device_;
  VkBuffer buffer_;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  void* mapped_ = nullptr;
};

}  // namespace

Buffer::Buffer(Device& device, std::size_t bytes)
    : device_(&device), size_(bytes == 0 ? 16 : (bytes + 3) / 4 * 4) {
  if (size_ > device.max_allocation()) {
    throw Error(ErrorCode::memory, "a buffer of " + std::to_string(size_ >> 20) + " MiB is above the " +
                                       std::to_string(device.max_allocation() >> 20) +
                                       " MiB that the device allocates at once; ask for smaller images");
  }
  const bool shared = device.info().type == "cpu" || device.info().type == "integrated";
  try {
    buffer_ = create_buffer(device.handle(), size_);
    memory_ = shared ? allocate(device, buffer_, {kMappable | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kMappable})
                     : allocate(device, buffer_, {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0});
    check(vkBindBufferMemory(device.handle(), buffer_, memory_, 0), "vkBindBufferMemory");
    if (shared) {
      void* mapped = nullptr;
      check(vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
      mapped_ = static_cast<std::byte*>(mapped);
    }
  } catch (...) {
    release();
    throw;
  }
}

Buffer::~Buffer() {
  release();
}

Buffer::Buffer(Buffer&& other) noexcept {
  *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(size_, other.size_);
  std::swap(mapped_, other.mapped_);
  return *this;
}

void Buffer::release() {
  if (device_ == nullptr) return;
  vkDestroyBuffer(device_->handle(), buffer_, nullptr);
  vkFreeMemory(device_->handle(), memory_, nullptr);
}

VkDeviceAddress Buffer::address() const {
  auto info = vk_struct<VkBufferDeviceAddressInfo>(VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO);
  info.buffer = buffer_;
  return vkGetBufferDeviceAddress(device_->handle(), &info);
}

void Buffer::require_inside(std::size_t offset, std::size_t bytes) const {
  if (offset > size_ || bytes > size_ - offset) {
    throw Error(ErrorCode::internal, "buffer access of " + std::to_string(bytes) + " bytes at " +
                                         std::to_string(offset) + " in a buffer of " + std::to_string(size_));
  }
}

void Buffer::write(std::size_t offset, std::span<const std::byte> bytes) {
  require_inside(offset, bytes.size());
  if (bytes.empty()) return;
  if (mapped_ != nullptr) {
    std::memcpy(mapped_ + offset, bytes.data(), bytes.size());
    return;
  }
  const Staging staging(*device_, std::min(bytes.size(), kStagingBytes));
  for (std::size_t done = 0; done < bytes.size(); done += kStagingBytes) {
    const std::size_t chunk = std::min(bytes.size() - done, kStagingBytes);
    std::memcpy(staging.data(), bytes.data() + done, chunk);
    device_->run([&](VkCommandBuffer commands) {
      const VkBufferCopy copy{0, offset + done, chunk};
      vkCmdCopyBuffer(commands, staging.handle(), buffer_, 1, &copy);
    });
  }
}

void Buffer::read(std::size_t offset, std::span<std::byte> bytes) {
  require_inside(offset, bytes.size());
  if (bytes.empty()) return;
  if (mapped_ != nullptr) {
    std::memcpy(bytes.data(), mapped_ + offset, bytes.size());
    return;
  }
  const Staging staging(*device_, std::min(bytes.size(), kStagingBytes));
  for (std::size_t done = 0; done < bytes.size(); done += kStagingBytes) {
    const std::size_t chunk = std::min(bytes.size() - done, kStagingBytes);
    device_->run([&](VkCommandBuffer commands) {
      const VkBufferCopy copy{offset + done, 0, chunk};
      vkCmdCopyBuffer(commands, buffer_, staging.handle(), 1, &copy);
    });
    std::memcpy(bytes.data() + done, staging.data(), chunk);
  }
}

void Buffer::clear() {
  if (mapped_ != nullptr) {
    std::memset(mapped_, 0, size_);
    return;
  }
  device_->run([&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, buffer_, 0, VK_WHOLE_SIZE, 0); });
}

}  // namespace vsgl::gpu
