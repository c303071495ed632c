#include "gpu/compute.h"

#include <array>
#include <chrono>
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
    case Binding::texel_rgba32ui:
      return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
  }
  throw Error(ErrorCode::internal, "unknown buffer binding");
}

// Of a texel buffer; no bytes: the binding is none.
struct TexelFormat {
  VkFormat format = VK_FORMAT_UNDEFINED;
  std::size_t bytes = 0;
};
TexelFormat texel_format(Binding binding) {
  switch (binding) {
    case Binding::texel_rgba32f:
      return {VK_FORMAT_R32G32B32A32_SFLOAT, 16};
    case Binding::texel_r32ui:
      return {VK_FORMAT_R32_UINT, 4};
    case Binding::texel_rgba32ui:
      return {VK_FORMAT_R32G32B32A32_UINT, 16};
    default:
      return {};
  }
}

// Largest range of a buffer that a binding may see, bytes.
std::size_t range_limit(const Device& device, Binding binding) {
  const VkPhysicalDeviceLimits& limits = device.limits();
  switch (binding) {
    case Binding::storage:
      return limits.maxStorageBufferRange;
    case Binding::uniform:
      return limits.maxUniformBufferRange;
    default:
      return texel_format(binding).bytes * limits.maxTexelBufferElements;
  }
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
  // Consecutive dispatches of one label, which are submitted and timed together.
  struct Segment {
    std::string label;
    int dispatches = 0;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkQueryPool timestamps = VK_NULL_HANDLE;  // two: begin and end; none where the device's are of no use
  };

  explicit Impl(Device& d) : device(d) {}
  ~Impl() { release(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // The command buffer of the last segment, which becomes a new one where the label is another.
  VkCommandBuffer record(const std::string& label);
  void begin(Segment& segment);
  void end(const Segment& segment);
  double run(const Segment& segment);  // seconds
  void release();
  void bind(VkCommandBuffer commands, const ComputePipeline::Impl& pipeline,
            const std::vector<BufferRange>& buffers);
  VkBufferView make_view(Binding binding, const BufferRange& range, std::size_t bytes);

  Device& device;
  std::vector<VkBufferView> views;
  std::vector<Segment> segments;
};

VkCommandBuffer Commands::Impl::record(const std::string& label) {
  if (segments.empty() || segments.back().label != label) {
    if (!segments.empty()) end(segments.back());
    begin(segments.emplace_back(Segment{.label = label}));
  }
  ++segments.back().dispatches;
  return segments.back().commands;
}

void Commands::Impl::begin(Segment& segment) {
  auto allocate = vk_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  allocate.commandPool = device.command_pool();
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device.handle(), &allocate, &segment.commands), "vkAllocateCommandBuffers");
  auto info = vk_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(segment.commands, &info), "vkBeginCommandBuffer");
  if (device.timestamp_period() == 0) return;
  auto queries = vk_struct<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
  queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queries.queryCount = 2;
  check(vkCreateQueryPool(device.handle(), &queries, nullptr, &segment.timestamps), "vkCreateQueryPool");
  vkCmdResetQueryPool(segment.commands, segment.timestamps, 0, 2);
  vkCmdWriteTimestamp(segment.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, segment.timestamps, 0);
}

void Commands::Impl::end(const Segment& segment) {
  full_barrier(segment.commands);
  if (segment.timestamps != VK_NULL_HANDLE)
    vkCmdWriteTimestamp(segment.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, segment.timestamps, 1);
  check(vkEndCommandBuffer(segment.commands), "vkEndCommandBuffer");
}

double Commands::Impl::run(const Segment& segment) {
  const auto start = std::chrono::steady_clock::now();
  auto info = vk_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  info.commandBufferCount = 1;
  info.pCommandBuffers = &segment.commands;
  check(vkQueueSubmit(device.queue(), 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
  check(vkQueueWaitIdle(device.queue()), "vkQueueWaitIdle");
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  if (segment.timestamps == VK_NULL_HANDLE) return elapsed.count();
  std::array<std::uint64_t, 2> ticks;
  check(vkGetQueryPoolResults(device.handle(), segment.timestamps, 0, 2, sizeof ticks, ticks.data(),
                              sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
  return static_cast<double>(ticks[1] - ticks[0]) * device.timestamp_period() * 1e-9;
}

void Commands::Impl::release() {
  for (VkBufferView view : views) vkDestroyBufferView(device.handle(), view, nullptr);
  for (const Segment& segment : segments) {
    vkDestroyQueryPool(device.handle(), segment.timestamps, nullptr);
    vkFreeCommandBuffers(device.handle(), device.command_pool(), 1, &segment.commands);
  }
  views.clear();
  segments.clear();
}

VkBufferView Commands::Impl::make_view(Binding binding, const BufferRange& range, std::size_t bytes) {
  auto info = vk_struct<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
  info.buffer = range.buffer->handle();
  const TexelFormat texel = texel_format(binding);
  info.format = texel.format;
  info.offset = range.offset;
  info.range = bytes / texel.bytes * texel.bytes;
  VkBufferView view = VK_NULL_HANDLE;
  check(vkCreateBufferView(device.handle(), &info, nullptr, &view), "vkCreateBufferView");
  views.push_back(view);
  return view;
}

void Commands::Impl::bind(VkCommandBuffer commands, const ComputePipeline::Impl& pipeline,
                          const std::vector<BufferRange>& buffers) {
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
    if (texel_format(binding).bytes > 0) texel_views[i] = make_view(binding, range, bytes);
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
  const VkCommandBuffer commands = impl_->record(label);
  full_barrier(commands);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, shader.pipeline);
  impl_->bind(commands, shader, buffers);
  if (!push.empty()) {
    vkCmdPushConstants(commands, shader.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<std::uint32_t>(push.size()), push.data());
  }
  vkCmdDispatch(commands, groups[0], groups[1], groups[2]);
}

namespace {

// Adds to the figure `dispatches`: label -> number of them.
void count_dispatches(Report& report, const std::string& label, int dispatches) {
  using nlohmann::ordered_json;
  ordered_json counted = report.to_json()["counts"].value("dispatches", ordered_json::object());
  counted[label] = counted.value(label, 0) + dispatches;
  report.count("dispatches", counted);
}

}  // namespace

void Commands::submit(Report& report) {
  if (impl_->segments.empty()) return;
  impl_->end(impl_->segments.back());
  for (const Impl::Segment& segment : impl_->segments) {
    report.device_time(segment.label, impl_->run(segment));
    count_dispatches(report, segment.label, segment.dispatches);
  }
  impl_->release();
}

}  // namespace vsgl::gpu
