#pragma once

#include <vulkan/vulkan.h>

namespace vsgl::gpu {

// A Vulkan structure with its type, the chain `next` and zeroes.
template <class T>
T vk_struct(VkStructureType type, void* next = nullptr) {
  T value{};
  value.sType = type;
  value.pNext = next;
  return value;
}

}  // namespace vsgl::gpu
