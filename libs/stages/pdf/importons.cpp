#include "stages/pdf/importons.h"

#include "base/find_method.h"
#include "kmeans/kmeans.h"
#include "math/interop_vec.h"
#include "math/sg.h"
#include "pyramid/kernels.h"
#include "stages/pdf/image_moments.h"

namespace vsgl {
namespace {

using interop::Importon;
using interop::Light;

// Least standard deviation of an importon, as a fraction of the scene's radius.
constexpr double footprint_floor = 1e-4;

// [Tokuyoshi 2016, section 5] The lights of the image, drawn by its reflectance.
std::vector<Light> image_lights(const GBuffer& gbuffer, const PdfParams& params, gpu::Device& device,
                                Report& report) {
  const GbufferGeneration& generation = gbuffer_generation(params.gbuffer_generation);
  const ImageMoments image = image_moments(gbuffer, !generation.is_clustering, device, report);
  if (image.density.empty()) return {};
  const DensityPyramid densities[] = {{image.size, image.density}};
  const std::span<const interop::Moments> moments[] = {image.moments};
  const double deviation = footprint_floor * gbuffer.scene_radius, variance_floor = deviation * deviation;
  KernelParams kernels;
  kernels.count = static_cast<std::uint32_t>(params.gbuffer_lights);
  kernels.seed = params.seed;
  if (generation.is_clustering) {
    const auto centres = choose_centres(densities, moments, generation.kind, kernels, device, report);
    const KmeansParams clusters{
        .space = generation.kind, .scene_radius = gbuffer.scene_radius, .variance_floor = variance_floor};
    return cluster_texels(moments, image.size, centres, clusters, device, report).lights;
  }
  kernels.rule = generation.kind;
  return filter_moments(draw_kernels(densities, kernels, device, report), moments, image.size, variance_floor,
                        device, report);
}

// Of several equal centres all but one have none.
bool has_power(const Light& light) {
  return luminance(to_double(light.power_diffuse) + to_double(light.power_specular)) > 0;
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

}  // namespace

const std::vector<GbufferGeneration>& gbuffer_generations() {
  static const std::vector<GbufferGeneration> generations = {
      {"fis-2014", "kernels sized by the density at their centres", false, interop::KERNEL_DENSITY},
      {"fis-2016", "kernels that hold equal shares of the samples", false, interop::KERNEL_NEWTON},
      {"kmeans-2d", "every pixel at the sampled one that is nearest in the image", true, interop::KMEANS_2D},
      {"kmeans-3d", "every pixel at the sampled one that is nearest in the scene", true, interop::KMEANS_3D},
  };
  return generations;
}

const GbufferGeneration& gbuffer_generation(const std::string& name) {
  return find_method(gbuffer_generations(), name, "gbuffer_generation");
}

std::vector<Importon> make_importons(const GBuffer& gbuffer, const PdfParams& params, gpu::Device& device,
                                     Report& report) {
  std::vector<Importon> importons;
  for (const Light& light : image_lights(gbuffer, params, device, report))
    if (has_power(light)) importons.push_back(make_importon(light));
  return importons;
}

}  // namespace vsgl
