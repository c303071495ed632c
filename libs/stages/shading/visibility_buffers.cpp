#include "stages/shading/visibility_buffers.h"

#include "base/error.h"

namespace vsgl {
namespace {

std::uint32_t word_of(std::uint32_t light) {
  return light / 32;
}

gpu::Buffer upload_views(const ShadowMaps* maps, gpu::Device& device) {
  std::vector<interop::ShadingView> views;
  if (maps)
    for (const ShadowMaps::View& view : maps->views) views.push_back({view.origin, view.axis});
  return gpu::Buffer::from(device, views);
}

}  // namespace

VisibilityBuffers::VisibilityBuffers(const Visibility* visibility, gpu::Device& device)
    : device_(device),
      maps_(std::get_if<ShadowMaps>(visibility)),
      bits_(std::get_if<VisibilityBits>(visibility)),
      atlas_(maps_ ? gpu::Buffer::from(device, maps_->inverse_distance) : gpu::Buffer(device, 0)),
      views_(upload_views(maps_, device)) {
  kind_ = maps_ ? interop::VISIBILITY_MAPS : bits_ ? interop::VISIBILITY_BITS : interop::VISIBILITY_NONE;
}

void VisibilityBuffers::describe(interop::ShadingPush& push) const {
  if (!maps_) return;
  push.tile = static_cast<std::uint32_t>(maps_->tile);
  push.columns = static_cast<std::uint32_t>(maps_->columns);
  push.disk_bias = static_cast<float>(maps_->bias_disk_radius / 4);
  push.normal_offset = static_cast<float>(maps_->normal_offset);
  push.slope_bias = static_cast<float>(maps_->slope_bias);
  push.relative_bias = static_cast<float>(maps_->relative_bias);
}

std::size_t VisibilityBuffers::row_of(std::uint32_t light) const {
  return light / static_cast<std::size_t>(maps_->columns);
}

std::size_t VisibilityBuffers::row_bytes() const {
  const auto tile = static_cast<std::size_t>(maps_->tile);
  return static_cast<std::size_t>(maps_->columns) * tile * tile * sizeof(float);
}

std::span<const std::uint32_t> VisibilityBuffers::leading(std::span<const std::uint32_t> lights,
                                                          std::size_t receivers) const {
  if (!maps_ && !bits_) return lights;
  const std::size_t visible = device_.limits().maxStorageBufferRange;
  const std::size_t units = visible / (maps_ ? row_bytes() : sizeof(std::uint32_t) * receivers);
  if (units == 0)
    throw Error(ErrorCode::device_limit,
                (maps_ ? "a row of the atlas of shadow maps exceeds"
                       : "visibility bits of " + std::to_string(receivers) + " pixels exceed") +
                    " the device's buffers of " + std::to_string(visible) + " bytes; use " +
                    (maps_ ? "smaller maps" : "a smaller image or shadow maps"));
  const auto unit_of = [&](std::uint32_t light) { return maps_ ? row_of(light) : word_of(light); };
  std::size_t count = lights.size();
  while (unit_of(lights[count - 1]) - unit_of(lights[0]) >= units) --count;
  return lights.first(count);
}

gpu::BufferRange VisibilityBuffers::maps(std::span<const std::uint32_t> lights) {
  if (!maps_) return atlas_;
  const std::size_t first = row_of(lights.front()), rows = row_of(lights.back()) - first + 1;
  return {atlas_, first * row_bytes(), rows * row_bytes()};
}

void VisibilityBuffers::locate(std::span<const std::uint32_t> lights, interop::ShadingPush& push) const {
  if (maps_) push.first_row = static_cast<std::uint32_t>(row_of(lights.front()));
  if (bits_) push.first_word = word_of(lights.front());
}

gpu::Buffer VisibilityBuffers::bits(std::span<const std::uint32_t> lights,
                                    std::span<const std::uint32_t> pixels) const {
  if (!bits_) return gpu::Buffer(device_, 0);
  const std::size_t image = static_cast<std::size_t>(bits_->width) * static_cast<std::size_t>(bits_->height);
  const std::size_t first = word_of(lights.front()), words = word_of(lights.back()) - first + 1;
  std::vector<std::uint32_t> gathered(words * pixels.size());
#pragma omp parallel for schedule(static)
  for (std::size_t w = 0; w < words; ++w)
    for (std::size_t i = 0; i < pixels.size(); ++i)
      gathered[w * pixels.size() + i] = bits_->words[(first + w) * image + pixels[i]];
  return gpu::Buffer::from(device_, gathered);
}

}  // namespace vsgl
