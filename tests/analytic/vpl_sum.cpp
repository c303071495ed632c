#include "vpl_sum.h"

#include <omp.h>

#include <algorithm>

#include "math/microfacet.h"

namespace vsgl::test {
namespace {

Vec3 widen(const interop::vec3& v) {
  return {v.x, v.y, v.z};
}

// Cosine below which two close points count as lying in one plane, where neither lights the other.
constexpr double coplanar = 0.01;

// A lit texel as a point light.
struct Vpl {
  Vec3 position, normal, shading_normal, incident;
  Vec3 diffuse, specular;  // reflected power, W
  double alpha = 1, footprint = 0;
  std::uint32_t ndf = 0;
};

Vec3 towards_source(const LightSource& light, Vec3 position) {
  return light.type == LightType::directional ? -light.forward : normalise(light.position - position);
}

std::vector<Vpl> vpls(const Rsm& rsm) {
  std::vector<Vpl> out;
  for (const RsmLayer& layer : rsm.layers)
    for (std::size_t j = 0; j < layer.surface.size(); ++j) {
      const interop::Surface& s = layer.surface[j];
      const interop::Moments& m = layer.pyramid[j];
      if (!(m.weight > 0)) continue;
      const Vec3 position = widen(s.position);
      out.push_back({position, widen(s.normal), widen(s.shading_normal),
                     towards_source(layer.light, position), widen(m.power_diffuse), widen(m.power_specular),
                     s.alpha, std::sqrt(6 * static_cast<double>(m.spread)), s.ndf});
    }
  return out;
}

}  // namespace

VplSum vpl_sum(const GBuffer& gbuffer, const Rsm& rsm) {
  const std::vector<Vpl> lights = vpls(rsm);
  const std::size_t count = gbuffer.pixels.size();
  VplSum out;
  out.diffuse.resize(count);
  out.specular.resize(count);
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t i = 0; i < count; ++i) {
    const interop::Surface& pixel = gbuffer.pixels[i];
    if (pixel.id == interop::NO_INSTANCE) continue;
    const Vec3 p = widen(pixel.position), n = widen(pixel.shading_normal),
               view = normalise(gbuffer.camera - p);
    for (const Vpl& light : lights) {
      const Vec3 v = light.position - p;
      const double d2 = dot(v, v);
      if (d2 == 0) continue;
      const Vec3 u = v / std::sqrt(d2);
      if (dot(u, widen(pixel.normal)) <= 0) continue;
      const double cosine = std::max(0.0, -dot(u, light.normal));
      Vec3 intensity = light.diffuse * (cosine / 3.141592653589793);
      if (light.ndf != interop::NDF_NONE && cosine > 0)
        intensity += light.specular *
                     specular_brdf_cos(light.ndf, light.alpha, light.shading_normal, light.incident, -u);
      out.diffuse[i] +=
          widen(pixel.diffuse) * intensity * (std::max(0.0, dot(u, n)) / (3.141592653589793 * d2));
      if (pixel.ndf != interop::NDF_NONE)
        out.specular[i] +=
            widen(pixel.specular) * intensity * (specular_brdf_cos(pixel.ndf, pixel.alpha, n, view, u) / d2);
    }
  }
  out.compared = far_from_texels(gbuffer, rsm);
  for (std::size_t i = 0; i < count; ++i)
    out.left_out += !out.compared[i] && gbuffer.pixels[i].id != interop::NO_INSTANCE;
  return out;
}

std::vector<bool> far_from_texels(const GBuffer& gbuffer, const Rsm& rsm, bool points) {
  const std::vector<Vpl> lights = vpls(rsm);
  std::vector<char> far(gbuffer.pixels.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t i = 0; i < far.size(); ++i) {
    const interop::Surface& pixel = gbuffer.pixels[i];
    if (pixel.id == interop::NO_INSTANCE) continue;
    far[i] = std::none_of(lights.begin(), lights.end(), [&](const Vpl& light) {
      const Vec3 v = light.position - widen(pixel.position);
      const double d = length(v), facing = std::min(dot(v, widen(pixel.normal)), -dot(v, light.normal));
      if (!points) return d <= light.footprint;
      const double lobe = std::min(static_cast<double>(pixel.alpha), light.alpha);  // width at distance 1
      return d * lobe <= light.footprint && facing >= coplanar * d;
    });
  }
  return {far.begin(), far.end()};
}

double reflected_power(const Rsm& rsm) {
  double sum = 0;
  for (const RsmLayer& layer : rsm.layers)
    for (std::size_t j = 0; j < layer.surface.size(); ++j)
      sum += luminance(widen(layer.pyramid[j].power_diffuse) + widen(layer.pyramid[j].power_specular));
  return sum;
}

double emitted_power(const Lights& lights) {
  double sum = 0;
  for (const interop::Light& light : lights.lights)
    sum += luminance(widen(light.power_diffuse) + widen(light.power_specular));
  return sum;
}

Agreement agreement(const Indirect& image, const VplSum& truth) {
  double truth_sum = 0, image_sum = 0, error_sum = 0;
  std::size_t count = 0;
  const auto image_at = [&](std::size_t i) {
    return luminance(widen(image.diffuse[i]) + (image.specular.empty() ? Vec3{} : widen(image.specular[i])));
  };
  for (std::size_t i = 0; i < truth.compared.size(); ++i) {
    if (!truth.compared[i]) continue;
    truth_sum += luminance(truth.diffuse[i] + truth.specular[i]);
    image_sum += image_at(i);
    ++count;
  }
  const double mean = truth_sum / static_cast<double>(count), epsilon = 0.02 * mean;
  for (std::size_t i = 0; i < truth.compared.size(); ++i) {
    if (!truth.compared[i]) continue;
    const double exact = luminance(truth.diffuse[i] + truth.specular[i]), error = image_at(i) - exact;
    error_sum += error * error / (exact * exact + epsilon * epsilon);
  }
  return {image_sum / truth_sum, error_sum / static_cast<double>(count)};
}

}  // namespace vsgl::test
