#include "scene/environment.h"

#include <algorithm>
#include <array>

#include "math/interop_vec.h"
#include "math/lobe.h"
#include "math/moments.h"
#include "math/sampling.h"
#include "pyramid/kernels.h"
#include "pyramid/moment_pyramid.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

using interop::Light;
using scene::Environment;

constexpr std::size_t kHalves = 2;  // of a map, left and right of its middle: each as wide as high

// The light from one or several texels of a map.
struct Bundle {
  Vec3 power;  // radiance times solid angle, W/m^2
  Vec3 mean;   // direction in which the light travels, in the world
  double deficit = 0;

  double weight() const { return luminance(power); }
};

Bundle bundle_of(const Environment& map, int column, int row) {
  const auto texel = scene::environment_texel(map, column, row);
  return {map.at(column, row) * texel.solid_angle, -map.rotation.direction(texel.mean),
          1 - dot(texel.mean, texel.mean)};
}

Bundle merge(const std::vector<Bundle>& bundles) {
  const MeanSpread lobe = merge_mean_spread(
      bundles.size(), [&](std::size_t k) { return bundles[k].weight(); },
      [&](std::size_t k) { return bundles[k].mean; }, [&](std::size_t k) { return bundles[k].deficit; });
  Bundle out{{}, lobe.mean, lobe.spread};
  for (const Bundle& bundle : bundles) out.power += bundle.power;
  return out;
}

interop::Moments to_moments(const Bundle& bundle) {
  interop::Moments out{};
  out.power_diffuse = to_float(bundle.power);
  out.weight = static_cast<float>(bundle.weight());
  out.diffuse_mean = to_float(bundle.mean);
  out.diffuse_deficit = static_cast<float>(bundle.deficit);
  return out;
}

// A map as the two layers of a pyramid.
struct Texels {
  int size = 0;  // a side of a layer, a power of two; what the map does not fill has no power
  std::array<std::vector<interop::Moments>, kHalves> moments;  // finest level, then the whole pyramid
  std::array<std::vector<float>, kHalves> density;             // mean 1 over both layers
};

// `block` x `block` texels of the map make one of a layer, exactly; at its edges fewer.
std::vector<interop::Moments> gather_half(const Environment& map, int first_column, int block, int size) {
  const int filled = (map.height + block - 1) / block;
  std::vector<interop::Moments> out(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
#pragma omp parallel for schedule(static)
  for (int y = 0; y < filled; ++y)
    for (int x = 0; x < filled; ++x) {
      std::vector<Bundle> bundles;
      for (int row = y * block; row < std::min((y + 1) * block, map.height); ++row)
        for (int column = x * block; column < std::min((x + 1) * block, map.height); ++column)
          bundles.push_back(bundle_of(map, first_column + column, row));
      out[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)] =
          to_moments(merge(bundles));
    }
  return out;
}

double total_weight(const Texels& texels) {
  double sum = 0;
  for (const auto& half : texels.moments)
    for (const interop::Moments& m : half) sum += static_cast<double>(m.weight);
  return sum;
}

void make_densities(Texels& texels) {
  const double count = static_cast<double>(kHalves * texels.moments.front().size());
  const double scale = count / total_weight(texels);
  for (std::size_t k = 0; k < kHalves; ++k) {
    std::vector<float> level0;
    level0.reserve(texels.moments[k].size());
    for (const interop::Moments& m : texels.moments[k])
      level0.push_back(static_cast<float>(static_cast<double>(m.weight) * scale));
    texels.density[k] = mean_pyramid(level0, texels.size);
  }
}

void make_pyramids(Texels& texels, gpu::Device& device, Report& report) {
  for (auto& half : texels.moments) {
    MomentPyramid pyramid(device, texels.size);
    pyramid.finest().write(0, std::as_bytes(std::span(half)));
    gpu::Commands commands(device);
    pyramid.merge(commands);
    commands.submit(report);
    half = pyramid.download();
  }
}

Texels make_texels(const Environment& map, int max_rows, gpu::Device& device, Report& report) {
  const PhaseTimer timer(report, "texels");
  int block = 1;
  while ((map.height + block - 1) / block > max_rows) block *= 2;
  Texels texels;
  texels.size = next_power_of_two((map.height + block - 1) / block);
  for (std::size_t k = 0; k < kHalves; ++k)
    texels.moments[k] = gather_half(map, static_cast<int>(k) * map.height, block, texels.size);
  report.count("rows", (map.height + block - 1) / block);
  make_densities(texels);
  make_pyramids(texels, device, report);
  return texels;
}

// What such a light does not have is empty, or its axis.
void complete(Light& light) {
  light.normal = light.diffuse_axis;
  light.shading_normal = light.incident = light.normal;
  light.alpha = 1;
}

// One factor a channel, so that the powers add up to `power`.
void conserve(std::vector<Light>& lights, Vec3 power) {
  Vec3 sum;
  for (const Light& light : lights) sum += to_double(light.power_diffuse);
  const auto ratio = [](double wanted, double found) { return found > 0 ? wanted / found : 0; };
  const Vec3 factor{ratio(power.x, sum.x), ratio(power.y, sum.y), ratio(power.z, sum.z)};
  for (Light& light : lights) light.power_diffuse = to_float(to_double(light.power_diffuse) * factor);
}

KernelParams kernel_params(const LightsParams& params) {
  KernelParams out;
  out.count = static_cast<std::uint32_t>(params.count);
  out.points = point_set_kind(params.points);
  out.rule = params.kernel_solver == "newton" ? interop::KERNEL_NEWTON : interop::KERNEL_BISECTION;
  out.scale = params.kernel_scale;
  out.seed = params.seed;
  return out;
}

}  // namespace

Vec3 environment_power(const Environment& environment) {
  Vec3 sum;
  for (int row = 0; row < environment.height; ++row)
    for (int column = 0; column < environment.width; ++column)
      sum += bundle_of(environment, column, row).power;
  return sum;
}

// [Tokuyoshi 2016, Sec. 3 and Sec. 7] kernels that hold equal shares of the samples, over texels of
// directions in place of an RSM's; the density is the luminance that arrives from a texel. Deviation: power
// is conserved in each channel by a common factor, see fis_2016.cpp.
std::vector<Light> sample_environment(const Environment& environment, const LightsParams& params,
                                      gpu::Device& device, Report& report) {
  const Texels texels = make_texels(environment, params.environment_size, device, report);
  std::vector<DensityPyramid> densities;
  std::vector<std::span<const interop::Moments>> moments;
  for (std::size_t k = 0; k < kHalves; ++k) {
    densities.push_back({texels.size, texels.density[k]});
    moments.emplace_back(texels.moments[k]);
  }
  const auto kernels = draw_kernels(densities, kernel_params(params), device, report);
  auto lights =
      filter_moments(kernels, moments, texels.size, 0, device, report, lobe_filter_kind(params.lobe_filter));
  std::erase_if(lights, [](const Light& light) { return !has_power(light); });
  for (Light& light : lights) complete(light);
  if (params.power == "conserved") conserve(lights, environment_power(environment));
  return lights;
}

}  // namespace vsgl
