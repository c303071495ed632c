#include "math/fvpl.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/interop_vec.h"
#include "math/mixture_lobe.h"

namespace vsgl {
namespace {

using interop::Cluster;

double wide(float x) {
  return static_cast<double>(x);
}

bool is_flat(double normal_sharpness) {
  return normal_sharpness > wide(interop::CLUSTER_FLAT);
}

}  // namespace

FvplView fvpl_view(Vec3 v, double inverse_variance) {
  const double d2 = dot(v, v), inverse_d2 = 1 / std::max(d2, 1e-24);
  return {v * std::sqrt(inverse_d2), d2, inverse_d2, std::min(d2 * inverse_variance, sharpness_max)};
}

bool fvpl_is_point(double sharpness, double across) {
  return sharpness > wide(interop::CLUSTER_POINT) &&
         sharpness > wide(interop::CLUSTER_POINT_SPECULAR) * across;
}

double fvpl_cosine(double c, double normal_sharpness) {
  return is_flat(normal_sharpness) ? std::max(c, 0.0) : cosine_mean(c, normal_sharpness);
}

double ggx_spread_d(double alpha2, double spread, double sin2, double cos2) {
  const double b = alpha2 + std::sqrt(2 * spread * (alpha2 + 2 * spread));
  const double q = std::max(sin2 + b * cos2, std::min(b, 1.0));
  return (alpha2 + 2 * b * (b - alpha2) * cos2 / q) / (std::numbers::pi * q * q);
}

double fvpl_specular(const Cluster& c, Vec3 w, double inverse_d2, double seen) {
  const Vec3 n = to_double(c.shading_normal), h = to_double(c.incident) + w;
  const double hn = dot(h, n), hh = std::max(dot(h, h), 1e-12);
  const double turn = wide(c.facet_turn);
  const double cosine = (1 - turn) * std::max(dot(w, n), 0.0) + turn * 0.5 * std::sqrt(hh);
  if (cosine <= 0) return 0;
  const Vec3 t = h - hn * n;
  const double sin2 = dot(t, t) / hh, cos2 = hn * hn / hh, surface = wide(c.masking_alpha2);
  const double alpha2 = std::min(wide(c.alpha2) + inverse_d2 / (2 * wide(c.inverse_variance)), 1.0);
  const double density =
      c.ndf == interop::NDF_GGX  // c.specular holds 1 / pi
          ? std::numbers::pi * ggx_spread_d(surface, std::max(alpha2 - surface, 0.0), sin2, cos2)
          : ndf_density(c.ndf, alpha2, sin2, cos2);
  const double masking = wide(c.incident_masking) + smith_lambda(c.ndf, wide(c.masking_alpha2), cosine);
  return density * seen / (std::max(cosine, cos_min) * masking);
}

Vec3 fvpl_emission_diffuse(const Cluster& c, Vec3 u) {
  return std::max(-dot(u, to_double(c.normal)), 0.0) * to_double(c.diffuse);
}

Vec3 fvpl_emission_flat(const Cluster& c, Vec3 u, double inverse_d2) {
  const double seen = std::max(-dot(u, to_double(c.normal)), 0.0);
  return seen * to_double(c.diffuse) + fvpl_specular(c, -u, inverse_d2, seen) * to_double(c.specular);
}

Vec3 fvpl_emission(const Cluster& c, Vec3 u, double inverse_d2) {
  const double seen = fvpl_cosine(-dot(u, to_double(c.normal)), wide(c.normal_sharpness));
  const Vec3 emission = seen * to_double(c.diffuse);
  if (c.ndf == interop::NDF_NONE) return emission;
  return emission + fvpl_specular(c, -u, inverse_d2, seen) * to_double(c.specular);
}

double fvpl_plane(const Cluster& c, Vec3 u, Vec3 receiver_normal, double cosine, double inverse_sharpness,
                  double blurred) {
  if (!is_flat(wide(c.normal_sharpness))) return 1;
  const Vec3 normal = to_double(c.normal);
  const double seen = std::max(-dot(u, normal), 0.0);
  const double bend = std::min(inverse_sharpness, 0.25) *
                      (cosine * (4 + blurred - 12 * seen * seen) - 4 * dot(normal, receiver_normal) * seen);
  return 1 + bend / std::max(cosine + std::abs(bend), 1e-20);
}

FvplReflection fvpl_point(const SpecularReceiver& r, const Cluster& c, const FvplView& view) {
  const double cosine = std::max(dot(view.u, r.normal), 0.0);
  const double inverse_sharpness = view.inverse_d2 / wide(c.inverse_variance);
  const double diffuse =
      cosine * fvpl_plane(c, view.u, r.normal, cosine, inverse_sharpness, 0) * std::numbers::inv_pi;
  const Vec3 eye{r.sin_view, 0, r.cos_view}, light = specular_local(r, view.u);
  const double specular =
      r.ndf == interop::NDF_NONE ? 0 : specular_brdf_cos(r.ndf, std::sqrt(r.alpha2), {0, 0, 1}, eye, light);
  return {view.inverse_d2 * diffuse, view.inverse_d2 * specular};
}

double fvpl_fluence(double d2, double inverse_variance) {
  const double sharpness = d2 * inverse_variance;
  return sharpness > 0.5 ? -std::expm1(-2 * sharpness) / d2 : 2 * phi(-2 * sharpness) * inverse_variance;
}

FvplReflection fvpl_extended(const SpecularReceiver& r, const Cluster& c, const FvplView& view) {
  const double fluence = fvpl_fluence(view.d2, wide(c.inverse_variance));
  const double cosine = cosine_mean(dot(view.u, r.normal), view.sharpness);
  const double inverse_sharpness = 1 / std::max(view.sharpness, 1.0);
  const double diffuse =
      cosine * fvpl_plane(c, view.u, r.normal, cosine, inverse_sharpness, 1) * std::numbers::inv_pi;
  const double specular = r.ndf == interop::NDF_NONE ? 0 : specular_vmf_mixture(r, view.u, view.sharpness);
  return {fluence * diffuse, fluence * specular};
}

}  // namespace vsgl
