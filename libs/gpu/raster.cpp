#include "gpu/raster.h"

#include <array>
#include <string>
#include <utility>

#include "base/error.h"
#include "gpu/shader_module.h"
#include "gpu/vk_struct.h"

namespace vsgl::gpu {
namespace {

constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

void require_drawable(const Device& device, std::uint32_t width, std::uint32_t height) {
  if (device.info().vector_bits > 256) {
    throw Error(ErrorCode::device_limit,
                "device \"" + device.info().name +
                    "\": cannot draw with vectors that wide; unset LP_NATIVE_VECTOR_WIDTH");
  }
  const std::uint32_t limit = device.limits().maxImageDimension2D;
  if (width > limit || height > limit) {
    throw Error(ErrorCode::device_limit, "device \"" + device.info().name + "\": cannot draw images of " +
                                             std::to_string(width) + "x" + std::to_string(height) +
                                             ", only up to " + std::to_string(limit) +
                                             " a side; ask for a smaller resolution");
  }
}

// Moves an image into a layout; its old contents are lost when `from` is undefined.
void transition(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, VkImageLayout from,
                VkImageLayout to) {
  auto barrier = vk_struct<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {aspect, 0, 1, 0, 1};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
                       nullptr, 0, nullptr, 1, &barrier);
}

VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout) {
  auto info = vk_struct<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  info.imageView = view;
  info.imageLayout = layout;
  info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  return info;
}

}  // namespace

RasterTarget::RasterTarget(Device& device, std::uint32_t width, std::uint32_t height,
                           std::vector<VkFormat> colours)
    : device_(device), width_(width), height_(height), formats_(std::move(colours)) {
  require_drawable(device, width, height);
  try {
    colours_.resize(formats_.size());
    for (std::size_t i = 0; i < formats_.size(); ++i) {
      create(colours_[i], formats_[i], VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
             VK_IMAGE_ASPECT_COLOR_BIT);
    }
    create(depth_, kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT);
  } catch (...) {
    release();
    throw;
  }
}

RasterTarget::~RasterTarget() {
  release();
}

void RasterTarget::create(Image& image, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) {
  auto info = vk_struct<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {width_, height_, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  check(vkCreateImage(device_.handle(), &info, nullptr, &image.image), "vkCreateImage");

  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device_.handle(), image.image, &needs);
  const int local = device_.memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  const int type = local >= 0 ? local : device_.memory_type(needs.memoryTypeBits, 0);
  auto allocate = vk_struct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex = static_cast<std::uint32_t>(type);
  check(vkAllocateMemory(device_.handle(), &allocate, nullptr, &image.memory), "vkAllocateMemory");
  check(vkBindImageMemory(device_.handle(), image.image, image.memory, 0), "vkBindImageMemory");

  auto view = vk_struct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view.image = image.image;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {aspect, 0, 1, 0, 1};
  check(vkCreateImageView(device_.handle(), &view, nullptr, &image.view), "vkCreateImageView");
}

void RasterTarget::release() {
  colours_.push_back(depth_);
  for (const Image& image : colours_) {
    vkDestroyImageView(device_.handle(), image.view, nullptr);
    vkDestroyImage(device_.handle(), image.image, nullptr);
    vkFreeMemory(device_.handle(), image.memory, nullptr);
  }
}

void RasterTarget::read(std::size_t colour, Buffer& buffer) {
  device_.run([&](VkCommandBuffer commands) {
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {width_, height_, 1};
    vkCmdCopyImageToBuffer(commands, colours_.at(colour).image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           buffer.handle(), 1, &copy);
  });
}

struct RasterPipeline::Impl {
  Device& device;
  std::vector<VkFormat> formats;
  std::size_t push_bytes;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;

  Impl(Device& d, std::vector<VkFormat> f, std::size_t p) : device(d), formats(std::move(f)), push_bytes(p) {}
  ~Impl() {
    vkDestroyPipeline(device.handle(), pipeline, nullptr);
    vkDestroyPipelineLayout(device.handle(), layout, nullptr);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void create_layout();
  void create_pipeline(std::span<const std::uint32_t> vertex_spirv,
                       std::span<const std::uint32_t> fragment_spirv);
};

namespace {

// All that a drawing pipeline depends on, each list behind its length.
Device::PipelineKey key_of(std::span<const std::uint32_t> vertex_spirv,
                           std::span<const std::uint32_t> fragment_spirv,
                           const std::vector<VkFormat>& formats, std::size_t push_bytes) {
  Device::PipelineKey key;
  for (const auto code : {vertex_spirv, fragment_spirv}) {
    key.push_back(static_cast<std::uint32_t>(code.size()));
    key.insert(key.end(), code.begin(), code.end());
  }
  for (const VkFormat format : formats) key.push_back(static_cast<std::uint32_t>(format));
  key.push_back(static_cast<std::uint32_t>(push_bytes));
  return key;
}

}  // namespace

RasterPipeline::RasterPipeline(Device& device, std::span<const std::uint32_t> vertex_spirv,
                               std::span<const std::uint32_t> fragment_spirv, std::vector<VkFormat> colours,
                               std::size_t push_bytes)
    : device_(device) {
  const auto build = [&] {
    auto impl = std::make_shared<Impl>(device, colours, push_bytes);
    impl->create_layout();
    impl->create_pipeline(vertex_spirv, fragment_spirv);
    return impl;
  };
  impl_ = std::static_pointer_cast<const Impl>(
      device.pipeline(key_of(vertex_spirv, fragment_spirv, colours, push_bytes), build));
}

void RasterPipeline::Impl::create_layout() {
  const VkPushConstantRange push{kStages, 0, static_cast<std::uint32_t>(push_bytes)};
  auto info = vk_struct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  info.pushConstantRangeCount = push_bytes > 0 ? 1 : 0;
  info.pPushConstantRanges = &push;
  check(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout), "vkCreatePipelineLayout");
}

void RasterPipeline::Impl::create_pipeline(std::span<const std::uint32_t> vertex_spirv,
                                           std::span<const std::uint32_t> fragment_spirv) {
  const ShaderModule vertex(device, vertex_spirv), fragment(device, fragment_spirv);
  const std::array stages{vertex.stage(VK_SHADER_STAGE_VERTEX_BIT),
                          fragment.stage(VK_SHADER_STAGE_FRAGMENT_BIT)};
  const auto input = vk_struct<VkPipelineVertexInputStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  auto assembly = vk_struct<VkPipelineInputAssemblyStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  auto viewport =
      vk_struct<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  auto raster = vk_struct<VkPipelineRasterizationStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  raster.polygonMode = VK_POLYGON_MODE_FILL;
  raster.cullMode = VK_CULL_MODE_NONE;
  raster.lineWidth = 1;
  auto samples = vk_struct<VkPipelineMultisampleStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  auto depth = vk_struct<VkPipelineDepthStencilStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  depth.depthTestEnable = VK_TRUE;
  depth.depthWriteEnable = VK_TRUE;
  depth.depthCompareOp = VK_COMPARE_OP_GREATER;
  VkPipelineColorBlendAttachmentState write_all{};
  write_all.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                             VK_COLOR_COMPONENT_A_BIT;
  const std::vector<VkPipelineColorBlendAttachmentState> blends(formats.size(), write_all);
  auto blend = vk_struct<VkPipelineColorBlendStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  blend.attachmentCount = static_cast<std::uint32_t>(blends.size());
  blend.pAttachments = blends.data();
  constexpr std::array kDynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  auto dynamic =
      vk_struct<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
  dynamic.dynamicStateCount = static_cast<std::uint32_t>(kDynamic.size());
  dynamic.pDynamicStates = kDynamic.data();
  auto rendering = vk_struct<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
  rendering.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
  rendering.pColorAttachmentFormats = formats.data();
  rendering.depthAttachmentFormat = kDepthFormat;
  auto info =
      vk_struct<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering);
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = layout;
  check(vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
}

void RasterPipeline::draw(RasterTarget& target, std::uint32_t vertices,
                          std::span<const std::byte> push) const {
  if (target.formats() != impl_->formats || push.size() != impl_->push_bytes) {
    throw Error(ErrorCode::internal,
                "a drawing pipeline got attachments or push constants that it was not made for");
  }
  device_.run([&](VkCommandBuffer commands) { record(commands, target, vertices, push); });
}

void RasterPipeline::record(VkCommandBuffer commands, RasterTarget& target, std::uint32_t vertices,
                            std::span<const std::byte> push) const {
  std::vector<VkRenderingAttachmentInfo> colours;
  for (const RasterTarget::Image& image : target.colours_) {
    transition(commands, image.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
               VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    colours.push_back(attachment(image.view, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL));
  }
  transition(commands, target.depth_.image, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
             VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
  const VkRenderingAttachmentInfo depth =
      attachment(target.depth_.view, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
  const VkRect2D area{{0, 0}, {target.width(), target.height()}};
  auto rendering = vk_struct<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  rendering.renderArea = area;
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = static_cast<std::uint32_t>(colours.size());
  rendering.pColorAttachments = colours.data();
  rendering.pDepthAttachment = &depth;
  vkCmdBeginRendering(commands, &rendering);
  if (vertices > 0) {
    const VkViewport viewport{0, 0, static_cast<float>(target.width()), static_cast<float>(target.height()),
                              0, 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &area);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, impl_->pipeline);
    if (!push.empty()) {
      vkCmdPushConstants(commands, impl_->layout, kStages, 0, static_cast<std::uint32_t>(push.size()),
                         push.data());
    }
    vkCmdDraw(commands, vertices, 1, 0, 0);
  }
  vkCmdEndRendering(commands);
  for (const RasterTarget::Image& image : target.colours_) {
    transition(commands, image.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  }
}

}  // namespace vsgl::gpu
