#include "gpu/device.h"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "gpu/environment.h"
#include "gpu/vk_struct.h"

namespace vsgl::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
std::atomic<int> validation_messages{0};

VKAPI_ATTR VkBool32 VKAPI_CALL on_validation_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                     VkDebugUtilsMessageTypeFlagsEXT,
                                                     const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                     void*) {
  std::fprintf(stderr, "validation: %s\n", data->pMessage);
  ++validation_messages;
  return VK_FALSE;
}

// Under AddressSanitizer: keeps lavapipe and the validation layer loaded after the instance, so that the leak
// checker can name, and tests/lsan.supp suppress, what they never free.
void pin_drivers_for_leak_checker() {
#ifdef __SANITIZE_ADDRESS__
  for (const char* library : {"libvulkan_lvp.so", "libVkLayer_khronos_validation.so"})
    dlopen(library, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
#endif
}

bool validation_wanted() {
  const char* value = std::getenv("VSGL_VALIDATION");
  return value != nullptr && std::strcmp(value, "1") == 0;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info() {
  auto info =
      vk_struct<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = on_validation_message;
  return info;
}

void require_validation_layer() {
  std::uint32_t count = 0;
  check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
  std::vector<VkLayerProperties> layers(count);
  check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
  const bool found = std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, kValidationLayer) == 0;
  });
  if (!found) {
    throw Error(ErrorCode::device_limit,
                std::string("VSGL_VALIDATION=1, but the layer ") + kValidationLayer +
                    " is not installed; install vulkan-validationlayers or unset it");
  }
}

std::string type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    default:
      return "other";
  }
}

bool is_gpu(const std::string& type) {
  return type == "discrete" || type == "integrated" || type == "virtual";
}

struct Candidate {
  VkPhysicalDevice device;
  std::string name, type;
};

std::vector<Candidate> list_devices(VkInstance instance) {
  std::uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
  std::vector<Candidate> candidates;
  for (VkPhysicalDevice device : devices) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    candidates.push_back({device, properties.deviceName, type_name(properties.deviceType)});
  }
  return candidates;
}

// "llvmpipe (LLVM 15.0.6, 256 bits)" -> 256; 0 for other drivers.
int vector_bits_of(const std::string& name) {
  const std::size_t end = name.find(" bits)");
  if (name.find("llvmpipe") == std::string::npos || end == std::string::npos) return 0;
  const std::size_t start = name.rfind(' ', end - 1);
  return std::atoi(name.c_str() + start + 1);
}

[[noreturn]] void throw_lacking(const DeviceInfo& info, const std::string& what) {
  throw Error(ErrorCode::device_limit,
              "device \"" + info.name + "\": lacks " + what + "; choose another with --device");
}

// The features that every stage may use, chained as Vulkan wants them. Not copyable: the chain points into
// itself.
struct Features {
  VkPhysicalDeviceVulkan13Features v13 =
      vk_struct<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  VkPhysicalDeviceVulkan12Features v12 =
      vk_struct<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  VkPhysicalDeviceFeatures2 all =
      vk_struct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);

  Features() {
    v12.pNext = &v13;
    all.pNext = &v12;
  }
  Features(const Features&) = delete;
  Features& operator=(const Features&) = delete;
};

void select_features(const Features& there, const DeviceInfo& info, Features& wanted) {
  if (!there.v12.scalarBlockLayout) throw_lacking(info, "scalar block layout");
  if (!there.v12.bufferDeviceAddress) throw_lacking(info, "buffer device addresses");
  if (!there.v13.dynamicRendering) throw_lacking(info, "dynamic rendering");
  wanted.v12.scalarBlockLayout = VK_TRUE;
  wanted.v12.bufferDeviceAddress = VK_TRUE;
  wanted.v13.dynamicRendering = VK_TRUE;
  wanted.all.features.shaderInt64 = there.all.features.shaderInt64;
}

}  // namespace

void check(VkResult result, const char* call) {
  if (result == VK_SUCCESS) return;
  const std::string text =
      std::string(call) + " failed with VkResult " + std::to_string(static_cast<int>(result));
  if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY) {
    throw Error(ErrorCode::memory, text + ": not enough memory; ask for smaller images or fewer lights");
  }
  throw Error(ErrorCode::device_lost, text);
}

void full_barrier(VkCommandBuffer commands) {
  auto barrier = vk_struct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                       nullptr, 0, nullptr);
}

Device::Device(const DeviceOptions& options) {
  ScopedEnvironment environment;  // read by lavapipe while instance and device are made
  set_lavapipe_threads(environment, options.threads);
  if (options.compute_only) set_lavapipe_wide(environment);
  try {
    create_instance(validation_wanted());
    pin_drivers_for_leak_checker();
    choose_physical(options.device);
    describe();
    create_device();
  } catch (...) {
    destroy();
    throw;
  }
}

Device::~Device() {
  destroy();
  if (validation_messages > 0) {
    std::fprintf(stderr, "validation: %d messages\n", validation_messages.load());
    std::abort();
  }
}

void Device::destroy() {
  pipelines_.clear();
  if (device_ != VK_NULL_HANDLE) {
    vkDestroyCommandPool(device_, pool_, nullptr);
    vkDestroyDevice(device_, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy_messenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy_messenger(instance_, messenger_, nullptr);
  }
  if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

void Device::create_instance(bool validation) {
  auto application = vk_struct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "vsgltools";
  application.apiVersion = VK_API_VERSION_1_3;
  auto info = vk_struct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info();
  if (validation) {
    require_validation_layer();
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }
  const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    instance_ = VK_NULL_HANDLE;
    throw Error(ErrorCode::no_device,
                "no Vulkan driver is installed; install mesa-vulkan-drivers for the CPU device");
  }
  check(result, "vkCreateInstance");
  if (!validation) return;
  const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  check(create_messenger(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

void Device::choose_physical(const std::string& wanted) {
  const std::vector<Candidate> candidates = list_devices(instance_);
  if (candidates.empty()) {
    throw Error(ErrorCode::no_device,
                "no Vulkan device found; install mesa-vulkan-drivers for the CPU device");
  }
  const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
    if (wanted == "auto" || wanted == "cpu") return candidate.type == "cpu";
    if (wanted == "gpu") return is_gpu(candidate.type);
    return !wanted.empty() && candidate.name.find(wanted) != std::string::npos;
  });
  if (found != candidates.end()) {
    physical_ = found->device;
    return;
  }
  if (wanted == "auto") {
    physical_ = candidates.front().device;
    return;
  }
  std::string list;
  for (const Candidate& candidate : candidates) {
    list += (list.empty() ? "\"" : ", \"") + candidate.name + "\" (" + candidate.type + ")";
  }
  throw Error(ErrorCode::no_device, "--device \"" + wanted + "\": no such Vulkan device; there are: " + list +
                                        "; name one or use auto");
}

void Device::describe() {
  auto subgroup =
      vk_struct<VkPhysicalDeviceSubgroupProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
  auto driver = vk_struct<VkPhysicalDeviceDriverProperties>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES, &subgroup);
  auto sizes = vk_struct<VkPhysicalDeviceMaintenance3Properties>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES, &driver);
  auto properties =
      vk_struct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &sizes);
  vkGetPhysicalDeviceProperties2(physical_, &properties);
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
  limits_ = properties.properties.limits;
  max_allocation_ = sizes.maxMemoryAllocationSize;
  const std::uint32_t version = properties.properties.apiVersion;
  info_.name = properties.properties.deviceName;
  info_.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  info_.type = type_name(properties.properties.deviceType);
  info_.api_version = std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
                      std::to_string(VK_API_VERSION_MINOR(version)) + "." +
                      std::to_string(VK_API_VERSION_PATCH(version));
  info_.vector_bits = vector_bits_of(info_.name);
  info_.subgroup_size = subgroup.subgroupSize;
  if (version < VK_API_VERSION_1_3) throw_lacking(info_, "Vulkan 1.3 (it has " + info_.api_version + ")");
}

void Device::create_device() {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  const auto family = std::find_if(
      families.begin(), families.end(),
      [](const VkQueueFamilyProperties& candidate) { return (candidate.queueFlags & kWanted) == kWanted; });
  if (family == families.end()) throw_lacking(info_, "a queue for both graphics and compute");
  family_ = static_cast<std::uint32_t>(family - families.begin());
  if (family->timestampValidBits > 0 && info_.type != "cpu")
    timestamp_period_ = static_cast<double>(limits_.timestampPeriod);

  Features there, wanted;
  vkGetPhysicalDeviceFeatures2(physical_, &there.all);
  select_features(there, info_, wanted);
  const float priority = 1;
  auto queue = vk_struct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  const char* extension = VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME;
  auto info = vk_struct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &wanted.all);
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = 1;
  info.ppEnabledExtensionNames = &extension;
  const VkResult result = vkCreateDevice(physical_, &info, nullptr, &device_);
  if (result == VK_ERROR_EXTENSION_NOT_PRESENT) throw_lacking(info_, extension);
  check(result, "vkCreateDevice");
  vkGetDeviceQueue(device_, family_, 0, &queue_);
  auto pool = vk_struct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = family_;
  check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "vkCreateCommandPool");
}

int Device::memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags wanted) const {
  for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
    const bool allowed = (type_bits >> i & 1u) != 0;
    if (allowed && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) return static_cast<int>(i);
  }
  return -1;
}

std::shared_ptr<void> Device::pipeline(const PipelineKey& key,
                                       const std::function<std::shared_ptr<void>()>& build) {
  std::packaged_task<std::shared_ptr<void>()> task(build);
  std::unique_lock lock(pipelines_lock_);
  const auto [place, is_new] = pipelines_.try_emplace(key);
  if (is_new) place->second = task.get_future().share();
  const std::shared_future<std::shared_ptr<void>> pipeline = place->second;
  lock.unlock();
  if (is_new) task();
  return pipeline.get();
}

void Device::run(const std::function<void(VkCommandBuffer)>& record) {
  auto allocate = vk_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  allocate.commandPool = pool_;
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(device_, &allocate, &commands), "vkAllocateCommandBuffers");
  struct Release {
    VkDevice device;
    VkCommandPool pool;
    VkCommandBuffer commands;
    ~Release() { vkFreeCommandBuffers(device, pool, 1, &commands); }
  } release{device_, pool_, commands};
  auto begin = vk_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  record(commands);
  full_barrier(commands);
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  auto submit = vk_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  check(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
}

}  // namespace vsgl::gpu
