#include "math/specular_lobe.h"

#include <algorithm>
#include <numbers>

#include "math/frame.h"

namespace vsgl {
namespace {

constexpr double pi = std::numbers::pi;

struct Horizon {
  double visible, cosine;
};

// A light as the receiver's local frame sees it.
struct Local {
  Vec3 light, view, half;  // half: unit
};

Local localise(const SpecularReceiver& r, Vec3 axis) {
  Local l;
  l.light = {dot(axis, r.tangent), dot(axis, r.bitangent), dot(axis, r.normal)};
  l.view = {r.sin_view, 0, r.cos_view};
  const Vec3 h = l.view + l.light;
  l.half = h / std::sqrt(std::max(dot(h, h), 1e-8));
  return l;
}

Horizon horizon_of(const SpecularReceiver& r, Vec3 light, double sharpness) {
  const Vec3 product = r.mirror + sharpness * light;
  const double l = std::max(length(product), 1e-15);
  const double c = std::clamp(product.z / l, -1.0, 1.0);
  const double visible = vmf_hemisphere(c, l);
  return {visible, std::clamp(cosine_mean(c, l) / std::max(visible, 1e-30), cos_min, 1.0)};
}

// Eigenvalues of the filtered matrix F (I + F)^-1, F = alpha^2 / (1 - alpha^2) + (2 / sharpness) J J^T.
struct Filter {
  double density, sigma;
};

Filter filter_of(const SpecularReceiver& r, const Local& l, double sharpness) {
  const double k = 1 - r.alpha2;
  const auto eigenvalue = [&](double spread) {
    const double denominator = spread + k;
    return denominator > 0 ? (spread * r.alpha2 + k) / denominator : 1;
  };
  const double par = eigenvalue(2 * sharpness);
  const double perp = eigenvalue(2 * sharpness * r.cos_view * r.cos_view);
  const Vec3 h = l.half;
  const double q = std::max(h.x * h.x / par + h.y * h.y / perp + h.z * h.z, 1.0);
  return {1 / (pi * std::sqrt(par * perp) * q * q),
          std::sqrt(r.sin_view * r.sin_view * par + r.cos_view * r.cos_view)};
}

double ramp(double x) {
  return std::clamp(x, 0.0, 1.0);
}

double masked(const SpecularReceiver& r, double cosine) {
  return 1 + r.view_lambda + smith_lambda(r.ndf, r.alpha2, cosine);
}

// D0 G2 / (4 cos_view) in a direction at `cosine` to the normal.
double coefficient(const SpecularReceiver& r, double cosine) {
  return cosine > 0 ? 1 / (4 * pi * r.alpha2 * r.cos_view * masked(r, cosine)) : 0;
}

Vec3 reflected(const SpecularReceiver& r) {
  return {-r.sin_view, 0, r.cos_view};
}

// [Xu 2013, Eq. (10)] without smooth term, over the SG's integral.
double asg_convolved(const SpecularReceiver& r, Vec3 light, double sharpness) {
  const double nu = sharpness / 2, eta_y = 2 / r.alpha2 / 8, eta_x = eta_y / (r.cos_view * r.cos_view);
  const Vec3 x{0, 1, 0}, y = cross(reflected(r), x);
  const double dx = dot(light, x), dy = dot(light, y);
  const double exponent = eta_x * nu / (eta_x + nu) * dx * dx + eta_y * nu / (eta_y + nu) * dy * dy;
  return pi * std::exp(-exponent) / std::sqrt((eta_x + nu) * (eta_y + nu)) / sg_integral(sharpness);
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
  r.alpha = alpha;
  r.alpha2 = alpha * alpha;
  r.across = ndf_sharpness(ndf, alpha) / (4 * r.cos_view * r.cos_view);
  const Vec3 local_view{r.sin_view, 0, r.cos_view};
  const Vec3 m = dominant_normal(r.alpha2, {0, 0, 1}, local_view);
  r.mirror = (1 - r.alpha2) / (2 * r.alpha2) * (2 * dot(local_view, m) * m - local_view);
  r.view_lambda = smith_lambda(ndf, r.alpha2, r.cos_view);
  r.ndf = ndf;
  return r;
}

double specular_vmf_filtered(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Local l = localise(r, axis);
  const Filter f = filter_of(r, l, sharpness);
  return horizon_of(r, l.light, sharpness).visible * f.density / (4 * f.sigma);
}

double specular_vmf_ggx(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Local l = localise(r, axis);
  const Filter f = filter_of(r, l, sharpness);
  const Horizon horizon = horizon_of(r, l.light, sharpness);
  const double view = ggx_lambda(r.alpha2, r.cos_view), light = ggx_lambda(r.alpha2, horizon.cosine);
  const double w = sharpness / (sharpness + 0.3 * r.across);
  const double scale = (1 - w) / (4 * f.sigma) + w / (2 * (r.cos_view + f.sigma));
  return horizon.visible * (1 + view) / (1 + view + light) * f.density * scale;
}

double specular_vmf_gaussian(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Local l = localise(r, axis);
  const Horizon horizon = horizon_of(r, l.light, sharpness);
  const Filter f = filter_of(r, l, sharpness);
  const double masking = masked(r, horizon.cosine);
  const double broad = horizon.visible * (1 + r.view_lambda) / masking * f.density / (4 * f.sigma);

  const double spread = 0.5 / std::max(sharpness, 1.0);
  const double par = r.alpha2 + spread, perp = r.alpha2 + spread / (r.cos_view * r.cos_view);
  const double density =
      std::exp(-l.half.x * l.half.x / par - l.half.y * l.half.y / perp) / (pi * std::sqrt(par * perp));
  const double narrow = horizon.visible * density / (4 * r.cos_view * masking);

  const double sharp = specular_brdf_cos(r.ndf, r.alpha, {0, 0, 1}, l.view, l.light);
  const double extended = std::lerp(broad, narrow, ramp(sharpness / 4 - 1));
  return std::lerp(extended, sharp, ramp((0.1 * sharpness - r.across) / (0.08 * std::max(sharpness, 1e-6))));
}

double specular_vmf(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  return r.ndf == interop::NDF_GGX ? specular_vmf_ggx(r, axis, sharpness)
                                   : specular_vmf_gaussian(r, axis, sharpness);
}

double specular_vmf_asg(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Vec3 light = localise(r, axis).light;
  return coefficient(r, light.z) * std::max(dot(light, reflected(r)), 0.0) *
         asg_convolved(r, light, sharpness);
}

double specular_vmf_asg_product(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Vec3 light = localise(r, axis).light;
  const Vec3 product = normalise(2 / r.alpha2 / (4 * r.cos_view) * reflected(r) + sharpness * light);
  const double w = ramp(sharpness / 4 - 1);
  const double smooth_term = std::max(dot((1 - w) * product + w * light, reflected(r)), 0.0);
  return coefficient(r, product.z) * smooth_term * asg_convolved(r, light, sharpness);
}

}  // namespace vsgl
