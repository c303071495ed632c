#include "vpl_sum.h"

#include <omp.h>

#include "math/lobe.h"
#include "math/microfacet.h"

namespace vsgl::test {
namespace {

Vec3 widen(const interop::vec3& v) {
  return {v.x, v.y, v.z};
}
interop::vec3 narrow(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

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
  std::vector<char> far(count, 1);
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t i = 0; i < count; ++i) {
    const interop::Surface& pixel = gbuffer.pixels[i];
    if (pixel.id == interop::NO_INSTANCE) continue;
    const Vec3 p = widen(pixel.position), n = widen(pixel.shading_normal),
               view = normalise(gbuffer.camera - p);
    for (const Vpl& light : lights) {
      const Vec3 v = light.position - p;
      const double d2 = dot(v, v);
      if (d2 <= light.footprint * light.footprint) far[i] = 0;
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
  out.compared.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (gbuffer.pixels[i].id == interop::NO_INSTANCE) continue;
    out.compared[i] = far[i];
    out.left_out += !far[i];
  }
  return out;
}

Lights lights_per_texel(const Rsm& rsm) {
  Lights out;
  out.method = "texels";
  out.anchor = rsm.anchor;
  out.scene_radius = rsm.scene_radius;
  for (std::size_t layer = 0; layer < rsm.layers.size(); ++layer) {
    const RsmLayer& view = rsm.layers[layer];
    for (std::size_t j = 0; j < view.surface.size(); ++j) {
      const interop::Surface& s = view.surface[j];
      const interop::Moments& m = view.pyramid[j];
      if (!(m.weight > 0)) continue;
      const SgLobe diffuse = lobe_decode({widen(m.diffuse_mean), m.diffuse_deficit});
      const SgLobe specular = lobe_decode({widen(m.specular_mean), m.specular_deficit});
      interop::Light light;
      light.position = light.origin = s.position;
      light.variance = std::max(m.spread / 2, 1e-12F);
      light.power_diffuse = m.power_diffuse;
      light.diffuse_axis = narrow(diffuse.axis);
      light.diffuse_sharpness = static_cast<float>(diffuse.sharpness);
      light.power_specular = m.power_specular;
      light.specular_axis = s.ndf == interop::NDF_NONE ? s.normal : narrow(specular.axis);
      light.specular_sharpness = s.ndf == interop::NDF_NONE ? 0 : static_cast<float>(specular.sharpness);
      light.alpha = s.alpha;
      light.ndf = s.ndf;
      light.normal = s.normal;
      light.shading_normal = s.shading_normal;
      light.incident = narrow(towards_source(view.light, widen(s.position)));
      light.texel = static_cast<std::uint32_t>(j);
      light.layer = static_cast<std::uint32_t>(layer);
      out.lights.push_back(light);
    }
  }
  out.requested = static_cast<int>(out.lights.size());
  return out;
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
