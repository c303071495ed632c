#include "stages/shading/light_pack.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interop/model.h"

namespace vsgl {
namespace {

using interop::Light;
using interop::ShadingLight;
using interop::vec3;

constexpr double kMinVariance = 1e-12;  // of the scene's radius squared
constexpr float kMinCosine = 1e-4f;     // as the shader library floors grazing cosines
constexpr float kMinLobeCosine = 0.1f;  // of a specular lobe's axis at the emitter
constexpr float kNeverCancelled = 1e30f;
constexpr float kMinSharpness = 1e-3f;  // as kernels/fused.glsl floors that of incoming light

float dot(vec3 a, vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
bool is_lit(vec3 power) {
  return power.x > 0 || power.y > 0 || power.z > 0;
}

// 1 / A(sharpness), A = (2 pi / l)(1 - e^(-2 l)) [Wang 2009].
float inverse_sg_integral(float sharpness) {
  const double l = sharpness;
  const double integral = l > 0 ? -2 * std::numbers::pi * std::expm1(-2 * l) / l : 4 * std::numbers::pi;
  return static_cast<float>(1 / integral);
}

ShadingLight pack_common(const Light& light, std::size_t index, double scene_radius) {
  ShadingLight out;
  out.position = light.position;
  out.variance = std::max(light.variance, static_cast<float>(kMinVariance * scene_radius * scene_radius));
  out.inverse_variance = 1 / out.variance;
  out.diffuse_axis = light.diffuse_axis;
  out.diffuse_sharpness = light.diffuse_sharpness;
  out.power_diffuse = light.power_diffuse;
  out.diffuse_scale = inverse_sg_integral(light.diffuse_sharpness);
  out.specular_axis = light.specular_axis;
  out.specular_sharpness = light.specular_sharpness;
  out.power_specular = light.power_specular;
  out.specular_scale = inverse_sg_integral(light.specular_sharpness);
  out.normal = light.normal;
  out.shading_normal = light.shading_normal;
  out.alpha = light.alpha;
  out.incident = light.incident;
  out.cos_incident = std::max(dot(light.incident, light.shading_normal), kMinCosine);
  out.ndf = is_lit(light.power_specular) ? light.ndf : interop::NDF_NONE;
  out.index = static_cast<std::uint32_t>(index);
  return out;
}

// A cluster may hold specular power although its representative point has no specular lobe: then there is no
// BRDF to fall back to. It keeps its SG; method vpl gives it the broadest lobe.
void replace_missing_brdf(ShadingLight& light) {
  if (light.ndf != interop::NDF_NONE || !is_lit(light.power_specular)) return;
  light.ndf = interop::NDF_GGX;
  light.alpha = 1;
  light.bandwidth = kNeverCancelled;
}

template <class Adapt>
std::vector<ShadingLight> pack(const Lights& lights, Adapt adapt) {
  std::vector<ShadingLight> out;
  out.reserve(lights.lights.size());
  for (const Light& light : lights.lights) {
    ShadingLight packed = pack_common(light, out.size(), lights.scene_radius);
    adapt(light, packed);
    replace_missing_brdf(packed);
    out.push_back(packed);
  }
  return out;
}

}  // namespace

std::vector<ShadingLight> pack_points(const Lights& lights) {
  return pack(lights, [](const Light& light, ShadingLight& out) { out.position = light.origin; });
}

std::vector<ShadingLight> pack_vsgl(const Lights& lights) {
  return pack(lights, [](const Light& light, ShadingLight& out) {
    out.bandwidth = is_lit(light.power_diffuse) ? light.diffuse_sharpness : 0;
    if (is_lit(light.power_specular)) out.bandwidth = std::max(out.bandwidth, light.specular_sharpness);
  });
}

std::vector<ShadingLight> pack_vsgl_2014(const Lights& lights) {
  return pack(lights, [](const Light& light, ShadingLight& out) {
    out.diffuse_sharpness = 0;
    out.diffuse_scale = static_cast<float>(1 / std::numbers::pi);
    out.specular_scale /= std::max(dot(light.specular_axis, light.normal), kMinLobeCosine);
    out.bandwidth = is_lit(light.power_specular) ? light.specular_sharpness : 0;
  });
}

std::vector<ShadingLight> pack_environment(const Lights& lights) {
  return pack(lights, [](const Light& light, ShadingLight& out) {
    out.diffuse_sharpness = std::max(light.diffuse_sharpness, kMinSharpness);
    out.diffuse_scale = inverse_sg_integral(out.diffuse_sharpness);
  });
}

}  // namespace vsgl
