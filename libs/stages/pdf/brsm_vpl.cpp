#include <cmath>

#include "pyramid/kernels.h"
#include "spirv/pdf/brsm_vpl.comp.glsl.h"  // after <cstdint>, which it needs
#include "stages/pdf/importance.h"
#include "stages/pdf/methods.h"

namespace vsgl {
namespace {

using interop::Reflector;

// Floor of the distance between texel and pixel, as a fraction of the scene's radius.
constexpr double distance_floor = 0.05;

interop::vec3 scaled(interop::vec3 c, float s) {
  return {c.x * s, c.y * s, c.z * s};
}

// Luminance of the reflectances of each pixel, padded to a square power of two, scaled to mean 1. Empty where
// nothing reflects.
std::vector<float> reflectance_pyramid(const GBuffer& gbuffer, int size) {
  std::vector<double> values(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  double sum = 0;
  for (int j = 0; j < gbuffer.height; ++j)
    for (int i = 0; i < gbuffer.width; ++i) {
      const interop::Surface& s =
          gbuffer.pixels[static_cast<std::size_t>(j) * static_cast<std::size_t>(gbuffer.width) +
                         static_cast<std::size_t>(i)];
      const Vec3 reflectance =
          Vec3{s.diffuse.x, s.diffuse.y, s.diffuse.z} + Vec3{s.specular.x, s.specular.y, s.specular.z};
      sum +=
          values[static_cast<std::size_t>(j) * static_cast<std::size_t>(size) + static_cast<std::size_t>(i)] =
              luminance(reflectance);
    }
  if (sum <= 0) return {};
  std::vector<float> level0;
  for (double v : values) level0.push_back(static_cast<float>(v * static_cast<double>(values.size()) / sum));
  return mean_pyramid(level0, size);
}

// Pixels drawn in proportion to their reflectance, which is divided by their density.
std::vector<Reflector> draw_view_samples(const GBuffer& gbuffer, const PdfParams& params, gpu::Device& device,
                                         Report& report) {
  const int size = next_power_of_two(std::max(gbuffer.width, gbuffer.height));
  const std::vector<float> pyramid = reflectance_pyramid(gbuffer, size);
  if (pyramid.empty()) return {};
  const DensityPyramid density[] = {{size, pyramid}};
  KernelParams kernels;
  kernels.count = static_cast<std::uint32_t>(params.view_samples);
  kernels.rule = interop::KERNEL_TEXEL;
  kernels.seed = params.seed;
  std::vector<Reflector> samples;
  for (const interop::Kernel& kernel : draw_kernels(density, kernels, device, report)) {
    const std::uint32_t i = kernel.texel % static_cast<std::uint32_t>(size),
                        j = kernel.texel / static_cast<std::uint32_t>(size);
    const interop::Surface& s = gbuffer.pixels[j * static_cast<std::size_t>(gbuffer.width) + i];
    const Vec3 w = normalise(gbuffer.camera - Vec3{s.position.x, s.position.y, s.position.z});
    samples.push_back({s.position,
                       s.alpha,
                       s.normal,
                       s.ndf,
                       s.shading_normal,
                       {static_cast<float>(w.x), static_cast<float>(w.y), static_cast<float>(w.z)},
                       scaled(s.diffuse, kernel.power_scale),
                       scaled(s.specular, kernel.power_scale)});
  }
  return samples;
}

}  // namespace

// [Ritschel 2011] the older estimate: light that each texel, as a virtual point light, sends to random
// pixels. Deviation: the same pixels for all texels.
TexelValues brsm_vpl_values(const Rsm& rsm, const GBuffer* gbuffer, const PdfParams& params,
                            gpu::Device& device, Report& report) {
  const std::vector<Reflector> samples = draw_view_samples(*gbuffer, params, device, report);
  report.count("view_samples", samples.size());
  ImportanceKernel kernel;
  kernel.spirv = brsm_vpl_comp_spv;
  kernel.sources = std::as_bytes(std::span(samples));
  kernel.source_bytes = sizeof(Reflector);
  kernel.source_ndf = common_ndf(*gbuffer, params.skip);
  kernel.distance2 = std::pow(distance_floor * gbuffer->scene_radius, 2);
  return sum_importance(rsm, kernel, params.skip, device, report);
}

}  // namespace vsgl
