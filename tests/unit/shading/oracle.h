#pragma once

// Sums over all lights of one pixel in double precision, from the functions of libs/math.

#include <map>
#include <numbers>
#include <string>

#include "box_scene.h"
#include "cluster/cluster.h"
#include "math/fvpl.h"
#include "math/microfacet.h"
#include "math/mixture_lobe.h"
#include "math/reflected_lobe.h"
#include "math/vsgl.h"

namespace vsgl::test {

struct Radiance {
  Vec3 diffuse, specular;
  double cancelled = 0;  // luminance from cancelled lights
};

struct OracleOptions {
  double cbr = 0;
  std::string lobe = "auto";
  double clamp_distance = 0;
};

struct OraclePixel {
  interop::Surface surface;
  Vec3 position, normal, geometric, view;

  OraclePixel(const GBuffer& gbuffer, std::size_t index)
      : surface(gbuffer.pixels[index]),
        position(to_double(surface.position)),
        normal(to_double(surface.shading_normal)),
        geometric(to_double(surface.normal)),
        view(normalise(gbuffer.camera - position)) {}
  bool is_specular() const { return surface.ndf != interop::NDF_NONE; }
};

// Radiance per watt-weighted colour of a light that sends `density` times its exact intensity from direction
// u.
inline Radiance exact_light(const OraclePixel& p, const interop::Light& light, Vec3 u, double density) {
  if (dot(p.geometric, u) <= 0) return {};
  const Vec3 normal = to_double(light.normal), shading = to_double(light.shading_normal);
  const double seen = std::max(dot(normal, -u), 0.0);
  Vec3 emitted = to_double(light.power_diffuse) * (seen / std::numbers::pi);
  const double cosine = dot(shading, -u);
  if (light.ndf != interop::NDF_NONE && cosine > 0)
    emitted +=
        to_double(light.power_specular) *
        (seen / cosine * specular_brdf_cos(light.ndf, light.alpha, shading, to_double(light.incident), -u));
  Radiance out;
  out.diffuse =
      to_double(p.surface.diffuse) * emitted * (density * std::max(dot(p.normal, u), 0.0) / std::numbers::pi);
  if (p.is_specular())
    out.specular = to_double(p.surface.specular) * emitted *
                   (density * specular_brdf_cos(p.surface.ndf, p.surface.alpha, p.normal, p.view, u));
  return out;
}

inline Radiance vpl_sum(const GBuffer& gbuffer, std::size_t index, const Lights& lights,
                        const OracleOptions& options = {}) {
  const OraclePixel p(gbuffer, index);
  Radiance sum;
  for (const interop::Light& light : lights.lights) {
    const Vec3 v = to_double(light.origin) - p.position;
    const double d2 = std::max(dot(v, v), options.clamp_distance * options.clamp_distance);
    const Radiance part = exact_light(p, light, normalise(v), 1 / d2);
    sum.diffuse += part.diffuse;
    sum.specular += part.specular;
  }
  return sum;
}

using SpecularForm = double (*)(const SpecularReceiver&, Vec3, double);
// By the names of specular_lobes().
inline SpecularForm specular_form(const std::string& lobe) {
  static const std::map<std::string, SpecularForm> forms = {
      {"auto", specular_vmf_mixture},
      {"mixture", specular_vmf_mixture},
      {"blend", specular_vmf_blend},
      {"sg", specular_vmf_sg},
      {"asg", specular_vmf_asg},
      {"asg-asg", specular_vmf_asg_asg},
      {"ndf-filter", specular_vmf_ndf_filter},
  };
  return forms.at(lobe);
}

inline Radiance fvpl_sum(const GBuffer& gbuffer, std::size_t index, const Lights& lights,
                         const OracleOptions& options = {}) {
  const OraclePixel p(gbuffer, index);
  const SpecularReceiver r = specular_receiver(p.surface.ndf, p.surface.alpha, p.normal, p.view);
  Radiance sum;
  for (const interop::Cluster& cluster : pack_clusters(lights)) {
    const double inverse_variance = cluster.inverse_variance;
    const FvplView view = fvpl_view(to_double(cluster.position) - p.position, inverse_variance);
    const Vec3 emission = fvpl_emission(cluster, view.u, view.inverse_d2);
    const FvplReflection reflection = fvpl_extended(r, cluster, view);
    sum.diffuse += to_double(p.surface.diffuse) * emission * reflection.diffuse;
    if (!p.is_specular()) continue;
    const double answer = specular_form(options.lobe)(r, view.u, view.sharpness);
    sum.specular +=
        to_double(p.surface.specular) * emission * (fvpl_fluence(view.d2, inverse_variance) * answer);
  }
  return sum;
}

// One emission lobe as the receiver answers it.
inline Radiance receive_lobe(const OraclePixel& p, Vec3 peak, const VsglIncoming& incoming,
                             const std::string& lobe) {
  Radiance out;
  out.diffuse =
      to_double(p.surface.diffuse) * peak *
      (incoming.fluence * cosine_mean(dot(incoming.axis, p.normal), incoming.sharpness) / std::numbers::pi);
  if (!p.is_specular()) return out;
  const SpecularReceiver r = specular_receiver(p.surface.ndf, p.surface.alpha, p.normal, p.view);
  const double value = specular_form(lobe)(r, incoming.axis, incoming.sharpness);
  out.specular = to_double(p.surface.specular) * peak * (incoming.fluence * value);
  return out;
}

inline double cancellation_weight(double ratio) {
  const double t = std::clamp(2 - 2 * ratio, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// `disk`: formulation of 2014. Normals must not be bumped.
inline Radiance vsgl_sum(const GBuffer& gbuffer, std::size_t index, const Lights& lights, bool disk,
                         const OracleOptions& options = {}) {
  const OraclePixel p(gbuffer, index);
  Radiance sum;
  for (const interop::Light& light : lights.lights) {
    const Vec3 v = to_double(light.position) - p.position, axis = to_double(light.specular_axis);
    const Vec3 normal = to_double(light.normal);
    const Vec3 u = dot(v, v) > 1e-24 ? normalise(v) : -normal;  // in the light itself: where it shines from
    const double diffuse_sharpness = disk ? 0 : light.diffuse_sharpness, sharpness = light.specular_sharpness;
    const double seen = std::max(dot(normal, -u), 0.0);
    const auto incoming = disk ? vsgl_incoming_disk : vsgl_incoming;
    const double diffuse_peak = disk ? seen / std::numbers::pi : 1 / sg_integral(diffuse_sharpness);
    const double specular_peak =
        (disk ? seen / std::max(dot(axis, normal), 0.1) : 1) / sg_integral(sharpness);
    const bool glossy = light.ndf != interop::NDF_NONE;
    const Radiance d = receive_lobe(
        p, to_double(light.power_diffuse) * diffuse_peak,
        incoming(v, light.variance, disk ? normal : to_double(light.diffuse_axis), diffuse_sharpness),
        options.lobe);
    const Radiance s = receive_lobe(p, to_double(light.power_specular) * specular_peak,
                                    incoming(v, light.variance, axis, sharpness), options.lobe);
    double weight = 0, density = 0;
    if (options.cbr > 0) {
      const double d2 =
          disk ? 1 / disk_cone(length(v), 4.0 * static_cast<double>(light.variance)).density : dot(v, v);
      double receiver = disk ? 0 : static_cast<double>(interop::LAMBDA_DIFFUSE);
      if (p.is_specular())
        receiver =
            std::max(receiver, specular_receiver(p.surface.ndf, p.surface.alpha, p.normal, p.view).across);
      const double emitter = std::max(diffuse_sharpness, glossy ? sharpness : 0);
      weight = cancellation_weight((receiver + emitter) * static_cast<double>(light.variance) /
                                   (options.cbr * d2));
      density = 1 / d2;
    }
    const Radiance exact = exact_light(p, light, u, weight * density);
    sum.diffuse += (1 - weight) * (d.diffuse + s.diffuse) + exact.diffuse;
    sum.specular += (1 - weight) * (d.specular + s.specular) + exact.specular;
    sum.cancelled += luminance(exact.diffuse + exact.specular);
  }
  return sum;
}

}  // namespace vsgl::test
