#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace vsgl::gpu {

struct DeviceOptions {
  std::string device = "auto";  // auto (a CPU device: lavapipe), cpu, gpu, or part of a device's name
  int threads = 0;              // lavapipe's worker threads; 0: all cores
  // The process promises never to draw, blit or sample images: lavapipe may then run 512 bits wide (1.4-1.7x
  // faster for compute; any draw crashes under it). Falls back to the default width where the CPU lacks
  // AVX-512.
  bool compute_only = false;
};

struct DeviceInfo {
  std::string name, driver, type;  // type: "cpu", "integrated", "discrete", "virtual"
  std::string api_version;
  int vector_bits = 0;  // of lavapipe: 128, 256, 512; 0 elsewhere
  std::uint32_t subgroup_size = 0;
};

// Vulkan instance, device, one queue (graphics and compute) and its command pool. Throws no_device when none
// matches, device_limit when a needed feature (Vulkan 1.3, scalar block layout, buffer addresses, push
// descriptors) is absent. VSGL_VALIDATION=1 in the environment turns the Khronos validation layer on; its
// messages go to stderr, prefixed "validation:", and the destructor aborts the process if there was any.
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
  // Nanoseconds per timestamp tick; 0: the queue has no timestamps, or none of use (lavapipe writes them
  // before the work is done).
  double timestamp_period() const { return timestamp_period_; }
  VkDeviceSize max_allocation() const { return max_allocation_; }
  // Index of a memory type with all of `wanted`, or -1.
  int memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags wanted) const;
  // Records commands, runs them and waits until their writes are visible to the host.
  void run(const std::function<void(VkCommandBuffer)>& record);

  // A pipeline that lives as long as the device: built by `build` when `key`, which describes it completely,
  // is asked for first, and shared from then on. Several threads may ask at once.
  using PipelineKey = std::vector<std::uint32_t>;
  std::shared_ptr<void> pipeline(const PipelineKey& key, const std::function<std::shared_ptr<void>()>& build);
  std::size_t pipelines_built() const { return pipelines_.size(); }

 private:
  void create_instance(bool validation);
  void choose_physical(const std::string& wanted);
  void describe();
  void create_device();
  void destroy();

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkPhysicalDeviceLimits limits_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  VkDeviceSize max_allocation_ = 0;
  double timestamp_period_ = 0;
  std::uint32_t family_ = 0;
  DeviceInfo info_;
  std::mutex pipelines_lock_;
  std::map<PipelineKey, std::shared_future<std::shared_ptr<void>>> pipelines_;
};

// Memory barrier: what was written before is visible to everything after, the host included.
void full_barrier(VkCommandBuffer commands);

// Throws device_lost naming the call (memory where there was too little).
void check(VkResult result, const char* call);

}  // namespace vsgl::gpu
