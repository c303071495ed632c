#pragma once

#include <cstdint>
#include <span>

#include "gpu/device.h"
#include "gpu/vk_struct.h"

namespace vsgl::gpu {

// SPIR-V code, needed only while pipelines are made from it. Its entry point is main().
class ShaderModule {
 public:
  ShaderModule(Device& device, std::span<const std::uint32_t> spirv) : device_(device.handle()) {
    auto info = vk_struct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    check(vkCreateShaderModule(device_, &info, nullptr, &module_), "vkCreateShaderModule");
  }
  ~ShaderModule() { vkDestroyShaderModule(device_, module_, nullptr); }
  ShaderModule(const ShaderModule&) = delete;
  ShaderModule& operator=(const ShaderModule&) = delete;

  VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits stage) const {
    auto info =
        vk_struct<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = stage;
    info.module = module_;
    info.pName = "main";
    return info;
  }

 private:
  VkDevice device_;
  VkShaderModule module_ = VK_NULL_HANDLE;
};

}  // namespace vsgl::gpu
