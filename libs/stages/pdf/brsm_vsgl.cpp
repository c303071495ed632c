#include <cmath>

#include "gpu/address.h"
#include "math/sg.h"
#include "pyramid/kernels.h"
#include "pyramid/moment_pyramid.h"
#include "spirv/pdf/brsm_vsgl.comp.glsl.h"  // after <cstdint>, which they need
#include "spirv/pdf/image_moments.comp.glsl.h"
#include "stages/pdf/importance.h"
#include "stages/pdf/methods.h"

namespace vsgl {
namespace {

using interop::Importon;
using interop::Light;
using interop::Moments;

constexpr int max_cells = 512;           // a side of the image's moment pyramid
constexpr std::uint32_t group_side = 8;  // of image_moments.comp.glsl
constexpr double footprint_floor =
    1e-4;  // least standard deviation of an importon, as a fraction of the scene's radius

struct ImagePyramid {
  int size = 0;
  std::vector<Moments> moments;
};

// The camera is the light, every pixel receives a flux of 1; padded to a square.
ImagePyramid image_pyramid(const GBuffer& gbuffer, gpu::Device& device, Report& report) {
  PhaseTimer timer(report, "image moments");
  const int pixels = next_power_of_two(std::max(gbuffer.width, gbuffer.height)),
            size = std::min(pixels, max_cells);
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
  pyramid.merge(commands);
  commands.submit(report);
  return {size, pyramid.download()};
}

interop::vec3 peak(interop::vec3 power, float sharpness) {
  const auto scale = static_cast<float>(1 / sg_integral(sharpness));
  return {power.x * scale, power.y * scale, power.z * scale};
}

Importon make_importon(const Light& light) {
  return {light.position,
          light.variance,
          light.diffuse_axis,
          light.diffuse_sharpness,
          peak(light.power_diffuse, light.diffuse_sharpness),
          light.specular_sharpness,
          light.specular_axis,
          peak(light.power_specular, light.specular_sharpness)};
}

// [Tokuyoshi 2016, section 5] VSGLs on the G-buffer, drawn by reflectance, which is the pyramid's weight.
// None where nothing reflects.
std::vector<Importon> make_importons(const GBuffer& gbuffer, const PdfParams& params, gpu::Device& device,
                                     Report& report) {
  const ImagePyramid image = image_pyramid(gbuffer, device, report);
  const float mean = image.moments.back().weight;
  if (mean <= 0) return {};
  std::vector<float> reflectance;
  for (const Moments& m : image.moments) reflectance.push_back(m.weight / mean);
  const DensityPyramid density[] = {{image.size, reflectance}};
  const std::span<const Moments> moments[] = {image.moments};
  KernelParams params_of_kernels;
  params_of_kernels.count = static_cast<std::uint32_t>(params.gbuffer_lights);
  params_of_kernels.seed = params.seed;
  const double deviation = footprint_floor * gbuffer.scene_radius;
  std::vector<Importon> importons;
  for (const Light& light : filter_moments(draw_kernels(density, params_of_kernels, device, report), moments,
                                           image.size, deviation * deviation, device, report))
    importons.push_back(make_importon(light));
  return importons;
}

}  // namespace

TexelValues brsm_vsgl_values(const Rsm& rsm, const GBuffer* gbuffer, const PdfParams& params,
                             gpu::Device& device, Report& report) {
  const std::vector<Importon> importons = make_importons(*gbuffer, params, device, report);
  report.count("gbuffer_lights", importons.size());
  ImportanceKernel kernel;
  kernel.spirv = brsm_vsgl_comp_spv;
  kernel.sources = std::as_bytes(std::span(importons));
  kernel.source_bytes = sizeof(Importon);
  kernel.source_ndf = common_ndf(*gbuffer, params.skip);
  return sum_importance(rsm, kernel, params.skip, device, report);
}

}  // namespace vsgl
