#include <algorithm>
#include <cmath>
#include <limits>
#include <list>

#include "base/error.h"
#include "gpu/address.h"
#include "gpu/compute.h"
#include "math/interop_vec.h"
#include "math/lobe.h"
#include "math/moments.h"
#include "pyramid/moment_pyramid.h"
#include "spirv/lights/gather.comp.glsl.h"  // after <cstdint>, which it needs
#include "stages/lights/filtered.h"
#include "stages/lights/methods.h"

namespace vsgl {
namespace {

using gpu::Buffer;
using interop::Light;
using interop::Moments;

constexpr int block_side = 8;            // texels that a step merges into one, a side
constexpr std::uint32_t group_side = 8;  // of gather.comp.glsl

enum Component : std::uint32_t { diffuse, specular };

struct GatherPush {
  interop::uvec2 fine_at, coarse_at;
  std::uint32_t size, block, component;
};

// A layer's texels on the device, their lobes encoded by a map LOBE_*.
Buffer upload_texels(const RsmLayer& layer, std::size_t texels, std::uint32_t lobe_filter,
                     gpu::Device& device, Report& report) {
  Buffer buffer = Buffer::from(device, std::span(layer.pyramid).first(texels));
  if (lobe_filter == interop::LOBE_BANERJEE) return buffer;
  gpu::Commands commands(device);
  encode_lobes(buffer, texels, lobe_filter, device, commands);
  commands.submit(report);
  return buffer;
}

// All texels of a layer as one: means a texel of their powers.
DoubleMoments gather(const Buffer& texels, int size, Component component, gpu::Device& device,
                     Report& report) {
  const gpu::ComputePipeline pipeline(device, gather_comp_spv, {}, sizeof(GatherPush));
  gpu::Commands commands(device);
  std::list<Buffer> levels;
  const Buffer* fine = &texels;
  for (int side = size; side > 1 || levels.empty();) {
    const int block = std::min(side, block_side);
    side /= block;
    const auto width = static_cast<std::uint32_t>(side), groups = gpu::groups_for(width, group_side);
    const Buffer& coarse = levels.emplace_back(device, sizeof(Moments) * width * width);
    const GatherPush push{address_of(*fine), address_of(coarse), width, static_cast<std::uint32_t>(block),
                          component};
    commands.dispatch("gather", pipeline, {}, push, {groups, groups, 1});
    fine = &coarse;
  }
  commands.submit(report);
  return to_double(levels.back().download<Moments>(1).front());
}

// The texel with power of that component that is nearest to the light's mean position; the first of several.
void choose_texel(Light& light, const Rsm& rsm, Component component, std::size_t texels) {
  double least = std::numeric_limits<double>::infinity();
  const Vec3 mean = to_double(light.position);
  for (std::size_t layer = 0; layer < rsm.layers.size(); ++layer)
    for (std::size_t texel = 0; texel < texels; ++texel) {
      const Moments& m = rsm.layers[layer].pyramid[texel];
      const Vec3 power = to_double(component == specular ? m.power_specular : m.power_diffuse);
      const Vec3 d = to_double(m.position) - mean;
      if (luminance(power) <= 0 || dot(d, d) >= least) continue;
      least = dot(d, d);
      light.texel = static_cast<interop::uint>(texel);
      light.layer = static_cast<interop::uint>(layer);
    }
}

// `moments`: sums of one component's powers, with its means.
Light make_light(const DoubleMoments& moments, const Rsm& rsm, Component component, std::uint32_t lobe_filter,
                 std::size_t texels) {
  const double floor = footprint_floor * rsm.scene_radius;
  Light light{};
  light.position = to_float(moments.position);
  light.variance = static_cast<float>(std::max(0.5 * moments.spread, floor * floor));
  const double normal_length = length(moments.normal_mean);
  if (normal_length > 0) light.normal = to_float(moments.normal_mean / normal_length);
  light.normal_deficit = static_cast<float>(moments.normal_deficit);
  if (component == specular) {
    const SgLobe lobe = lobe_decode_by(lobe_filter, {moments.specular_mean, moments.specular_deficit});
    light.power_specular = to_float(moments.power_specular);
    light.specular_axis = to_float(lobe.axis);
    light.specular_sharpness = static_cast<float>(lobe.sharpness);
  } else {
    const SgLobe lobe = lobe_decode_by(lobe_filter, {moments.diffuse_mean, moments.diffuse_deficit});
    light.power_diffuse = to_float(moments.power_diffuse);
    light.diffuse_axis = to_float(lobe.axis);
    light.diffuse_sharpness = static_cast<float>(lobe.sharpness);
  }
  light.level = 0.5f * std::log2(static_cast<float>(rsm.texel_count()));
  choose_texel(light, rsm, component, texels);
  represent(light, rsm.layers[light.layer]);
  return light;
}

}  // namespace

// [Tokuyoshi 2015] all of the RSM as one diffuse and one specular VSGL, each with its own footprint and lobe.
LightSet generate_two_vsgl(const Rsm& rsm, const Pdf*, const LightsParams& params, gpu::Device* device,
                           Report& report) {
  const std::uint32_t lobe_filter = lobe_filter_kind(params.lobe_filter);
  if (lobe_filter == interop::LOBE_NONE)
    throw Error(
        ErrorCode::bad_value,
        "lobe_filter: none leaves method two-vsgl without lobes: it samples no texel; choose another");
  report.skipped("sampling",
                 "method two-vsgl sums up all texels: density, count, points and kernels play no part");
  const std::size_t texels = rsm.texel_count() / rsm.layers.size();
  std::vector<DoubleMoments> parts[2];
  for (const RsmLayer& layer : rsm.layers) {
    const Buffer buffer = upload_texels(layer, texels, lobe_filter, *device, report);
    for (const Component component : {diffuse, specular})
      parts[component].push_back(gather(buffer, rsm.size, component, *device, report));
  }
  const std::vector<double> shares(rsm.layers.size(), static_cast<double>(texels));
  LightSet set;
  for (const Component component : {diffuse, specular}) {
    const DoubleMoments sum = merge_moments(parts[component], shares);
    if (sum.weight > 0) set.lights.push_back(make_light(sum, rsm, component, lobe_filter, texels));
  }
  return set;
}

}  // namespace vsgl
