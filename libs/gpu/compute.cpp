#include "gpu/compute.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "gpu/shader_module.h"
#include "gpu/vk_struct.h"

namespace vsgl::gpu {
namespace {

VkDescriptorType descriptor_type(Binding binding) {
  switch (binding) {
    case Binding::storage:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case Binding::uniform:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case Binding::texel_rgba32f:
    case Binding::texel_r32ui:
      return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
  }
  throw Error(ErrorCode::internal, "unknown buffer binding");
}

bool is_texel(Binding binding) {
  return binding == Binding::texel_rgba32f || binding == Binding::texel_r32ui;
}

// Largest range of a buffer that a binding may see, bytes.
std::size_t range_limit(const Device& device, Binding binding) {
  const VkPhysicalDeviceLimits& limits = device.limits();
  switch (binding) {
    case Binding::storage:
      return limits.maxStorageBufferRange;
    case Binding::uniform:
      return limits.maxUniformBufferRange;
    case Binding::texel_rgba32f:
      return std::size_t{16} * limits.maxTexelBufferElements;
    case Binding::texel_r32ui:
      return std::size_t{4} * limits.maxTexelBufferElements;
  }
  throw Error(ErrorCode::internal, "unknown buffer binding");
}

}  // namespace

struct ComputePipeline::Impl {
  Device& device;
  std::vector<Binding> bindings;
  std::size_t push_bytes;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;

  Impl(Device& d, std::vector<Binding> b, std::size_t p) : device(d), bindings(std::move(b)), push_bytes(p) {}
  ~Impl() {
    vkDestroyPipeline(device.handle(), pipeline, nullptr);
    vkDestroyPipelineLayout(device.handle(), layout, nullptr);
    vkDestroyDescriptorSetLayout(device.handle(), set_layout, nullptr);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void create_layout();
  void create_pipeline(std::span<const std::uint32_t> spirv, const SpecializationConstants& constants);
};

void ComputePipeline::Impl::create_layout() {
  std::vector<VkDescriptorSetLayoutBinding> slots(bindings.size());
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    slots[i] = {static_cast<std::uint32_t>(i), descriptor_type(bindings[i]), 1, VK_SHADER_STAGE_COMPUTE_BIT,
                nullptr};
  }
  auto set_info =
      vk_struct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_info.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  set_info.bindingCount = static_cast<std::uint32_t>(slots.size());
  set_info.pBindings = slots.data();
  check(vkCreateDescriptorSetLayout(device.handle(), &set_info, nullptr, &set_layout),
        "vkCreateDescriptorSetLayout");
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<std::uint32_t>(push_bytes)};
  auto info = vk_struct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout;
  info.pushConstantRangeCount = push_bytes > 0 ? 1 : 0;
  info.pPushConstantRanges = &push;
  check(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout), "vkCreatePipelineLayout");
}

void ComputePipeline::Impl::create_pipeline(std::span<const std::uint32_t> spirv,
                                            const SpecializationConstants& constants) {
  std::vector<VkSpecializationMapEntry> entries;
  std::vector<std::uint32_t> values;
  for (const auto& [id, value] : constants) {
    entries.push_back({id, static_cast<std::uint32_t>(values.size() * sizeof(value)), sizeof(value)});
    values.push_back(value);
  }
  const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                            values.size() * sizeof(std::uint32_t), values.data()};
  const ShaderModule module(device, spirv);
  auto info = vk_struct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage = module.stage(VK_SHADER_STAGE_COMPUTE_BIT);
  info.stage.pSpecializationInfo = &specialization;
  info.layout = layout;
  check(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "vkCreateComputePipelines");
}

namespace {

// All that a compute pipeline depends on, each list behind its length.
Device::PipelineKey key_of(std::span<const std::uint32_t> spirv, const std::vector<Binding>& bindings,
                           std::size_t push_bytes, const SpecializationConstants& constants) {
  Device::PipelineKey key{static_cast<std::uint32_t>(spirv.size())};
  key.insert(key.end(), spirv.begin(), spirv.end());
  key.push_back(static_cast<std::uint32_t>(bindings.size()));
  for (const Binding binding : bindings) key.push_back(static_cast<std::uint32_t>(binding));
  key.push_back(static_cast<std::uint32_t>(push_bytes));
  for (const auto& [id, value] : constants) key.insert(key.end(), {id, value});
  return key;
}

}  // namespace

ComputePipeline::ComputePipeline(Device& device, std::span<const std::uint32_t> spirv,
                                 std::vector<Binding> bindings, std::size_t push_bytes,
                                 const SpecializationConstants& constants) {
  const auto build = [&] {
    auto impl = std::make_shared<Impl>(device, bindings, push_bytes);
    impl->create_layout();
    impl->create_pipeline(spirv, constants);
    return impl;
  };
  impl_ = std::static_pointer_cast<const Impl>(
      device.pipeline(key_of(spirv, bindings, push_bytes, constants), build));
}

struct Commands::Impl {
  static constexpr std::uint32_t kQueriesPerPool = 256;

  explicit Impl(Device& d) : device(d) {}
  ~Impl() { release(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void begin();
  void release();
  void timestamp();
  std::vector<double> elapsed_s() const;
  void bind(const ComputePipeline::Impl& pipeline, const std::vector<BufferRange>& buffers);
  VkBufferView make_view(Binding binding, const BufferRange& range, std::size_t bytes);

  Device& device;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  std::vector<VkBufferView> views;
  std::vector<VkQueryPool> query_pools;
  std::vector<std::string> labels;  // a new one where the label of a dispatch differs from the last
  std::uint32_t timestamps = 0;
};

void Commands::Impl::begin() {
  if (commands != VK_NULL_HANDLE) return;
  auto allocate = vk_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  allocate.commandPool = device.command_pool();
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device.handle(), &allocate, &commands), "vkAllocateCommandBuffers");
  auto info = vk_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
}

void Commands::Impl::release() {
  for (VkBufferView view : views) vkDestroyBufferView(device.handle(), view, nullptr);
  for (VkQueryPool pool : query_pools) vkDestroyQueryPool(device.handle(), pool, nullptr);
  if (commands != VK_NULL_HANDLE) vkFreeCommandBuffers(device.handle(), device.command_pool(), 1, &commands);
  views.clear();
  query_pools.clear();
  labels.clear();
  timestamps = 0;
  commands = VK_NULL_HANDLE;
}

void Commands::Impl::timestamp() {
  if (device.timestamp_period() == 0) return;
  const std::uint32_t index = timestamps % kQueriesPerPool;
  if (index == 0) {
    auto info = vk_struct<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kQueriesPerPool;
    VkQueryPool pool = VK_NULL_HANDLE;
    check(vkCreateQueryPool(device.handle(), &info, nullptr, &pool), "vkCreateQueryPool");
    query_pools.push_back(pool);
    vkCmdResetQueryPool(commands, pool, 0, kQueriesPerPool);
  }
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, query_pools.back(), index);
  ++timestamps;
}

// Seconds between one timestamp and the next.
std::vector<double> Commands::Impl::elapsed_s() const {
  std::vector<std::uint64_t> ticks(timestamps);
  for (std::uint32_t first = 0; first < timestamps; first += kQueriesPerPool) {
    const std::uint32_t count = std::min(timestamps - first, kQueriesPerPool);
    check(vkGetQueryPoolResults(device.handle(), query_pools[first / kQueriesPerPool], 0, count,
                                count * sizeof(std::uint64_t), ticks.data() + first, sizeof(std::uint64_t),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
  }
  std::vector<double> seconds;
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    seconds.push_back(static_cast<double>(ticks[i] - ticks[i - 1]) * device.timestamp_period() * 1e-9);
  }
  return seconds;
}

VkBufferView Commands::Impl::make_view(Binding binding, const BufferRange& range, std::size_t bytes) {
  auto info = vk_struct<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
  info.buffer = range.buffer->handle();
  info.format = binding == Binding::texel_rgba32f ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32_UINT;
  info.offset = range.offset;
  const std::size_t texel = binding == Binding::texel_rgba32f ? 16 : 4;
  info.range = bytes / texel * texel;
  VkBufferView view = VK_NULL_HANDLE;
  check(vkCreateBufferView(device.handle(), &info, nullptr, &view), "vkCreateBufferView");
  views.push_back(view);
  return view;
}

void Commands::Impl::bind(const ComputePipeline::Impl& pipeline, const std::vector<BufferRange>& buffers) {
  const std::size_t count = pipeline.bindings.size();
  if (buffers.size() != count) {
    throw Error(ErrorCode::internal, "a shader with " + std::to_string(count) + " bindings got " +
                                         std::to_string(buffers.size()) + " buffers");
  }
  std::vector<VkDescriptorBufferInfo> infos(count);
  std::vector<VkBufferView> texel_views(count);
  std::vector<VkWriteDescriptorSet> writes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const BufferRange& range = buffers[i];
    const Binding binding = pipeline.bindings[i];
    const std::size_t bytes = range.size > 0 ? range.size : range.buffer->size() - range.offset;
    if (range.offset + bytes > range.buffer->size()) {
      throw Error(ErrorCode::internal,
                  "binding " + std::to_string(i) + " reaches past the end of its buffer");
    }
    if (bytes > range_limit(device, binding)) {
      throw Error(ErrorCode::device_limit, "device \"" + device.info().name + "\": a shader may see " +
                                               std::to_string(range_limit(device, binding) >> 10) +
                                               " KiB of a buffer, not " + std::to_string(bytes >> 10) +
                                               "; ask for smaller images or fewer lights");
    }
    infos[i] = {range.buffer->handle(), range.offset, bytes};
    if (is_texel(binding)) texel_views[i] = make_view(binding, range, bytes);
    writes[i] = vk_struct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    writes[i].dstBinding = static_cast<std::uint32_t>(i);
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = descriptor_type(binding);
    writes[i].pBufferInfo = &infos[i];
    writes[i].pTexelBufferView = &texel_views[i];
  }
  const auto push_descriptors = reinterpret_cast<PFN_vkCmdPushDescriptorSetKHR>(
      vkGetDeviceProcAddr(device.handle(), "vkCmdPushDescriptorSetKHR"));
  if (count > 0) {
    push_descriptors(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0,
                     static_cast<std::uint32_t>(count), writes.data());
  }
}

Commands::Commands(Device& device) : impl_(std::make_unique<Impl>(device)) {}
Commands::~Commands() = default;

void Commands::dispatch(const std::string& label, const ComputePipeline& pipeline,
                        const std::vector<BufferRange>& buffers, std::span<const std::byte> push,
                        std::array<std::uint32_t, 3> groups) {
  const ComputePipeline::Impl& shader = *pipeline.impl_;
  const std::uint32_t* limit = impl_->device.limits().maxComputeWorkGroupCount;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (groups[axis] > limit[axis]) {
      throw Error(ErrorCode::device_limit, label + ": " + std::to_string(groups[axis]) +
                                               " workgroups along one axis, the device takes " +
                                               std::to_string(limit[axis]) +
                                               "; ask for smaller images or fewer lights");
    }
  }
  if (push.size() != shader.push_bytes) {
    throw Error(ErrorCode::internal, label + ": the shader takes " + std::to_string(shader.push_bytes) +
                                         " bytes of push constants, not " + std::to_string(push.size()));
  }
  impl_->begin();
  full_barrier(impl_->commands);
  if (impl_->labels.empty() || impl_->labels.back() != label) {
    impl_->labels.push_back(label);
    impl_->timestamp();
  }
  vkCmdBindPipeline(impl_->commands, VK_PIPELINE_BIND_POINT_COMPUTE, shader.pipeline);
  impl_->bind(shader, buffers);
  if (!push.empty()) {
    vkCmdPushConstants(impl_->commands, shader.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<std::uint32_t>(push.size()), push.data());
  }
  vkCmdDispatch(impl_->commands, groups[0], groups[1], groups[2]);
}

void Commands::submit(Report& report) {
  if (impl_->commands == VK_NULL_HANDLE) return;
  Device& device = impl_->device;
  full_barrier(impl_->commands);
  impl_->timestamp();
  check(vkEndCommandBuffer(impl_->commands), "vkEndCommandBuffer");
  auto info = vk_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  info.commandBufferCount = 1;
  info.pCommandBuffers = &impl_->commands;
  check(vkQueueSubmit(device.queue(), 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
  check(vkQueueWaitIdle(device.queue()), "vkQueueWaitIdle");
  const std::vector<double> seconds = impl_->elapsed_s();
  for (std::size_t i = 0; i < seconds.size(); ++i) report.device_time(impl_->labels[i], seconds[i]);
  impl_->release();
}

}  // namespace vsgl::gpu
