#include "math/reflected_lobe.h"

#include <algorithm>
#include <numbers>

namespace vsgl {
namespace {

constexpr double pi = std::numbers::pi;

Vec3 mirror(const SpecularReceiver& r) {
  return {-r.sin_view, 0, r.cos_view};
}

}  // namespace

double specular_coefficient(const SpecularReceiver& r, double cosine) {
  if (cosine <= 0) return 0;
  const double masking = 1 + r.view_lambda + smith_lambda(r.ndf, r.alpha2, cosine);
  return 1 / (4 * pi * r.alpha2 * r.cos_view * masking);
}

Vec3 reflected_local(const SpecularReceiver& r, Vec3 light) {
  const Vec3 x{0, 1, 0}, y = cross(x, mirror(r));
  return {dot(light, x), dot(light, y), dot(light, mirror(r))};
}

ReflectedBandwidths reflected_bandwidths(const SpecularReceiver& r) {
  const double lambda_h = 2 / r.alpha2;
  return {lambda_h / (8 * r.cos_view * r.cos_view), lambda_h / 8};
}

double specular_vmf_sg(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const SgProduct product = sg_product(mirror(r), r.across * r.cos_view, specular_local(r, axis), sharpness);
  return specular_coefficient(r, product.axis.z) * std::exp(product.exponent) *
         sg_integral(product.sharpness) / sg_integral(sharpness);
}

double specular_asg_convolved(const SpecularReceiver& r, Vec3 light, double sharpness) {
  const double nu = sharpness / 2;
  const auto [eta_x, eta_y] = reflected_bandwidths(r);
  const double exponent =
      eta_x * nu / (eta_x + nu) * light.x * light.x + eta_y * nu / (eta_y + nu) * light.y * light.y;
  return pi * std::exp(-exponent) / std::sqrt((eta_x + nu) * (eta_y + nu)) / sg_integral(sharpness);
}

double specular_vmf_asg(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Vec3 light = specular_local(r, axis);
  const auto [eta_x, eta_y] = reflected_bandwidths(r);
  const Vec3 product = normalise(2 * std::sqrt(eta_x * eta_y) * mirror(r) + sharpness * light);
  const double w = std::clamp(sharpness / 4 - 1, 0.0, 1.0);
  const double smooth_term = std::max(dot((1 - w) * product + w * light, mirror(r)), 0.0);
  return specular_coefficient(r, product.z) * smooth_term *
         specular_asg_convolved(r, reflected_local(r, light), sharpness);
}

// Least eigenvalue nu m of diag(eta_x, eta_y, 0) + nu (I - light light^T), from the secular equation
// m = sum over x, y of light_i^2 eta_i / (eta_i + nu (1 - m)).
AsgProduct asg_product(Vec3 light, double eta_x, double eta_y, double nu) {
  const double x2 = light.x * light.x, y2 = light.y * light.y;
  double m = 0;
  for (int i = 0; i < 5; ++i) {
    const double px = eta_x + nu * (1 - m), py = eta_y + nu * (1 - m);
    const double value = x2 * eta_x / px + y2 * eta_y / py - m;
    const double slope = 1 - nu * (x2 * eta_x / (px * px) + y2 * eta_y / (py * py));
    m = std::min(m + value / std::max(slope, 1e-3), x2 + y2);
  }
  const double p = std::max(1 - m, 1e-12), px = eta_x + nu * p, py = eta_y + nu * p;
  const Vec3 w{light.x * nu * p / px, light.y * nu * p / py, light.z};
  const double l = std::max(length(w), 1e-12);
  return {w / l, nu * m, pi * std::max(light.z, 0.0) * p * std::sqrt(p / (px * py)) / (l * l * l)};
}

double specular_vmf_asg_asg(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const auto [eta_x, eta_y] = reflected_bandwidths(r);
  const AsgProduct product =
      asg_product(reflected_local(r, specular_local(r, axis)), eta_x, eta_y, sharpness / 2);
  const double cosine = r.sin_view * product.axis.y + r.cos_view * product.axis.z;
  return specular_coefficient(r, cosine) * std::exp(-product.exponent) * product.integral /
         sg_integral(sharpness);
}

}  // namespace vsgl
