#include "stages/pdf/image_moments.h"

#include <algorithm>

#include "gpu/address.h"
#include "interop/importance.h"
#include "pyramid/moment_pyramid.h"
#include "spirv/pdf/image_moments.comp.glsl.h"  // after <cstdint>, which it needs

namespace vsgl {
namespace {

using interop::Moments;

constexpr int max_cells = 512;           // a side of the image
constexpr std::uint32_t group_side = 8;  // of image_moments.comp.glsl

std::vector<float> density_of(std::span<const Moments> cells, int size) {
  double sum = 0;
  for (const Moments& m : cells) sum += static_cast<double>(m.weight);
  if (sum <= 0) return {};
  const double scale = static_cast<double>(cells.size()) / sum;
  std::vector<float> density;
  density.reserve(cells.size());
  for (const Moments& m : cells) density.push_back(static_cast<float>(scale * static_cast<double>(m.weight)));
  return mean_pyramid(density, size);
}

}  // namespace

ImageMoments image_moments(const GBuffer& gbuffer, bool mipmapped, gpu::Device& device, Report& report) {
  PhaseTimer timer(report, "image moments");
  const int pixels = next_power_of_two(std::max(gbuffer.width, gbuffer.height)),
            size = std::min(pixels, max_cells);
  const std::size_t cells = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const gpu::Buffer surfaces = gpu::Buffer::from(device, gbuffer.pixels);
  MomentPyramid pyramid(device, size);
  const interop::ImageMomentsPush push{
      address_of(surfaces),
      address_of(pyramid.finest()),
      {static_cast<float>(gbuffer.camera.x), static_cast<float>(gbuffer.camera.y),
       static_cast<float>(gbuffer.camera.z)},
      static_cast<std::uint32_t>(gbuffer.width),
      static_cast<std::uint32_t>(gbuffer.height),
      static_cast<std::uint32_t>(size),
      static_cast<std::uint32_t>(pixels / size)};
  const gpu::ComputePipeline pipeline(device, image_moments_comp_spv, {}, sizeof push);
  const std::uint32_t groups = gpu::groups_for(push.size, group_side);
  gpu::Commands commands(device);
  commands.dispatch("image moments", pipeline, {}, push, {groups, groups, 1});
  if (mipmapped) pyramid.merge(commands);
  commands.submit(report);
  ImageMoments image{size, mipmapped ? pyramid.download() : pyramid.finest().download<Moments>(cells), {}};
  image.density = density_of(std::span(image.moments).first(cells), size);
  return image;
}

}  // namespace vsgl
