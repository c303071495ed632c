#include "math/specular_lobe.h"

#include <algorithm>
#include <numbers>

#include "math/frame.h"

namespace vsgl {
namespace {

constexpr double pi = std::numbers::pi;

double ramp(double x) {
  return std::clamp(x, 0.0, 1.0);
}

Vec3 local_view(const SpecularReceiver& r) {
  return {r.sin_view, 0, r.cos_view};
}

Vec3 half_vector(const SpecularReceiver& r, Vec3 light) {
  const Vec3 h = local_view(r) + light;
  return h / std::sqrt(std::max(dot(h, h), 1e-8));
}

double masked(const SpecularReceiver& r, double cosine) {
  return 1 + r.view_lambda + smith_lambda(r.ndf, r.alpha2, cosine);
}

}  // namespace

SpecularReceiver specular_receiver(std::uint32_t ndf, double alpha, Vec3 normal, Vec3 view) {
  SpecularReceiver r;
  const double c = dot(view, normal);
  const Vec3 t = view - c * normal;
  r.tangent = dot(t, t) > 1e-12 ? normalise(t) : frame_about(normal).x;
  r.bitangent = cross(normal, r.tangent);
  r.normal = normal;
  r.sin_view = length(t);
  r.cos_view = std::max(c, cos_min);
  r.alpha2 = alpha * alpha;
  r.across = ndf_sharpness(ndf, alpha) / (4 * r.cos_view * r.cos_view);
  const Vec3 v = local_view(r), m = dominant_normal(r.alpha2, {0, 0, 1}, v);
  r.across_cos2 = r.cos_view * dot(v, m);
  r.mirror = (1 - r.alpha2) / (2 * r.alpha2) * (2 * dot(v, m) * m - v);
  r.view_lambda = smith_lambda(ndf, r.alpha2, r.cos_view);
  r.ndf = ndf;
  return r;
}

Vec3 specular_local(const SpecularReceiver& r, Vec3 w) {
  return {dot(w, r.tangent), dot(w, r.bitangent), dot(w, r.normal)};
}

SpecularHorizon specular_horizon(const SpecularReceiver& r, Vec3 light, double sharpness) {
  const Vec3 product = r.mirror + sharpness * light;
  const double l = std::max(length(product), 1e-15);
  const double c = std::clamp(product.z / l, -1.0, 1.0);
  const double visible = vmf_hemisphere(c, l);
  return {visible, std::clamp(cosine_mean(c, l) / std::max(visible, 1e-30), cos_min, 1.0)};
}

// Eigenvalues of the filtered matrix F (I + F)^-1, F = alpha^2 / (1 - alpha^2) + (2 / sharpness) J J^T.
SpecularFilter specular_filter(const SpecularReceiver& r, Vec3 light, double sharpness) {
  const double k = 1 - r.alpha2;
  const auto eigenvalue = [&](double spread) {
    const double denominator = spread + k;
    return denominator > 0 ? (spread * r.alpha2 + k) / denominator : 1;
  };
  const double par = eigenvalue(2 * sharpness);
  const double perp = eigenvalue(2 * sharpness * r.cos_view * r.cos_view);
  const Vec3 h = half_vector(r, light);
  const double q = std::max(h.x * h.x / par + h.y * h.y / perp + h.z * h.z, 1.0);
  return {1 / (pi * std::sqrt(par * perp) * q * q),
          std::sqrt(r.sin_view * r.sin_view * par + r.cos_view * r.cos_view)};
}

double specular_vmf_filtered(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Vec3 light = specular_local(r, axis);
  const SpecularFilter f = specular_filter(r, light, sharpness);
  return specular_horizon(r, light, sharpness).visible * f.density / (4 * f.slope_cosine);
}

double specular_vmf_ggx(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Vec3 light = specular_local(r, axis);
  const SpecularFilter f = specular_filter(r, light, sharpness);
  const SpecularHorizon horizon = specular_horizon(r, light, sharpness);
  const double masking = ggx_lambda(r.alpha2, r.cos_view) + 1;
  const double w = sharpness / (sharpness + 0.3 * r.across);
  const double scale = (1 - w) / (4 * f.slope_cosine) + w / (2 * (r.cos_view + f.slope_cosine));
  return horizon.visible * masking / (masking + ggx_lambda(r.alpha2, horizon.cosine)) * f.density * scale;
}

double specular_vmf_projected(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Vec3 light = specular_local(r, axis);
  const SpecularHorizon horizon = specular_horizon(r, light, sharpness);
  const SpecularFilter f = specular_filter(r, light, sharpness);
  const double masking = masked(r, horizon.cosine);
  const double broad = horizon.visible * (1 + r.view_lambda) / masking * f.density / (4 * f.slope_cosine);

  const double spread = 0.5 / std::max(sharpness, 1.0);
  const double par = r.alpha2 + spread, perp = r.alpha2 + spread / (r.cos_view * r.cos_view);
  const Vec3 h = half_vector(r, light);
  const double density = std::exp(-h.x * h.x / par - h.y * h.y / perp) / (pi * std::sqrt(par * perp));
  const double narrow = horizon.visible * density / (4 * r.cos_view * masking);
  return std::lerp(broad, narrow, ramp(sharpness / 4 - 1));
}

double specular_vmf_gaussian(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Vec3 light = specular_local(r, axis);
  const double sharp = specular_brdf_cos(r.ndf, std::sqrt(r.alpha2), {0, 0, 1}, local_view(r), light);
  return std::lerp(specular_vmf_projected(r, axis, sharpness), sharp,
                   ramp((0.1 * sharpness - r.across) / (0.08 * std::max(sharpness, 1e-6))));
}

double specular_vmf_blend(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  return r.ndf == interop::NDF_GGX ? specular_vmf_ggx(r, axis, sharpness)
                                   : specular_vmf_gaussian(r, axis, sharpness);
}

double specular_vmf_ndf_filter(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  return r.ndf == interop::NDF_GGX ? specular_vmf_filtered(r, axis, sharpness)
                                   : specular_vmf_projected(r, axis, sharpness);
}

}  // namespace vsgl
