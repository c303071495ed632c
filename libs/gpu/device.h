#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace vsgl::gpu {

struct DeviceOptions {
  std::string device = "auto";  // auto (a CPU device: lavapipe), cpu, gpu, or part of a device's name
  int threads = 0;              // lavapipe's worker threads; 0: all cores
  // The process promises never to draw, blit or sample images: lavapipe may then run 512 bits wide (1.4-1.7x faster for compute;
  // any draw crashes under it). Falls back to the default width where the CPU lacks AVX-512.
  bool compute_only = false;
};

struct DeviceInfo {
  std::string name, driver, type;  // type: "cpu", "integrated", "discrete", "virtual"
  std::string api_version;
  int vector_bits = 0;  // of lavapipe: 128, 256, 512; 0 elsewhere
  std::uint32_t subgroup_size = 0;
};

// Vulkan instance, device, one queue (graphics and compute) and its command pool. Throws no_device when none matches, device_limit
// when a needed feature (Vulkan 1.2, scalar block layout) is absent. VSGL_VALIDATION=1 in the environment turns the Khronos
// validation layer on; its messages go to stderr, prefixed "validation:", and make the destructor's process exit non-zero.
class Device {
 public:
  explicit Device(const DeviceOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const { return info_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  VkDevice handle() const { return device_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkQueue queue() const { return queue_; }
  VkCommandPool command_pool() const { return pool_; }
  // Index of a memory type with all of `wanted`, or -1.
  int memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags wanted) const;

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkPhysicalDeviceLimits limits_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  DeviceInfo info_;
};

// Throws device_lost naming the call.
void check(VkResult result, const char* call);

}  // namespace vsgl::gpu
