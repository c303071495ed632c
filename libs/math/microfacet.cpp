#include "math/microfacet.h"

#include <algorithm>
#include <numbers>

namespace vsgl {

using interop::NDF_BECKMANN, interop::NDF_GGX, interop::NDF_PHONG;

constexpr double pi = std::numbers::pi;

double ggx_d(double alpha2, double sin2, double cos2) {
  const double q = std::max(sin2 / alpha2 + cos2, 1.0);
  return 1 / (pi * alpha2 * q * q);
}

double beckmann_d(double alpha2, double sin2, double cos2) {
  const double c2 = std::max(cos2, 1e-8);
  return std::exp(-sin2 / (alpha2 * c2)) / (pi * alpha2 * c2 * c2);
}

double phong_d(double alpha2, double sin2, double cos2) {
  const double log_cos2 = sin2 < 0.5 ? std::log1p(-sin2) : std::log(std::max(cos2, 1e-12));
  return std::exp((1 / alpha2 - 1) * log_cos2) / (pi * alpha2);
}

double ndf_density(std::uint32_t ndf, double alpha2, double sin2, double cos2) {
  if (ndf == NDF_GGX) return ggx_d(alpha2, sin2, cos2);
  if (ndf == NDF_BECKMANN) return beckmann_d(alpha2, sin2, cos2);
  return phong_d(alpha2, sin2, cos2);
}

double ggx_slope_cosine(double alpha2, double c) {
  return std::sqrt(c * c + alpha2 * std::max(1 - c * c, 0.0));
}

double ggx_lambda(double alpha2, double c) {
  c = std::max(c, cos_min);
  const double tan2 = std::max(1 - c * c, 0.0) / (c * c);
  return 0.5 * (std::sqrt(1 + alpha2 * tan2) - 1);
}

double beckmann_lambda(double alpha2, double c) {
  c = std::max(c, cos_min);
  const double a = c / std::sqrt(std::max(alpha2 * (1 - c * c), 1e-12));
  return std::max(0.5 * (std::exp(-a * a) / (a * std::sqrt(pi)) - std::erfc(a)), 0.0);
}

double smith_lambda(std::uint32_t ndf, double alpha2, double c) {
  return ndf == NDF_GGX ? ggx_lambda(alpha2, c) : beckmann_lambda(alpha2, c);
}

double ndf_sharpness(std::uint32_t ndf, double alpha) {
  const double a2 = alpha * alpha, n = 2 / a2 - 2;
  return std::max(ndf == NDF_PHONG ? n + std::clamp((n - 1) / 3, 0.0, 1.0) : 2 / a2 - 2 * a2, 1e-3);
}

double specular_brdf_cos(std::uint32_t ndf, double alpha, Vec3 normal, Vec3 view, Vec3 light) {
  const double alpha2 = alpha * alpha;
  const double cos_view = std::max(dot(view, normal), cos_min), cos_light = dot(light, normal);
  if (cos_light <= 0) return 0;
  const Vec3 h = view + light;
  const double hn = dot(h, normal), hh = std::max(dot(h, h), 1e-12);
  const Vec3 t = h - hn * normal;
  const double masking = 1 + smith_lambda(ndf, alpha2, cos_view) + smith_lambda(ndf, alpha2, cos_light);
  return ndf_density(ndf, alpha2, dot(t, t) / hh, hn * hn / hh) / (4 * cos_view * masking);
}

Vec3 dominant_normal(double alpha2, Vec3 normal, Vec3 view) {
  const double c = std::max(dot(view, normal), cos_min);
  const Vec3 tangential = view - dot(view, normal) * normal;
  return normalise(alpha2 * tangential +
                   (c + std::sqrt(alpha2 * dot(tangential, tangential) + c * c)) * normal);
}

SgLobe specular_lobe(std::uint32_t ndf, double alpha, Vec3 normal, Vec3 view) {
  const double c = dot(view, normal);
  return {normalise(2 * c * normal - view), ndf_sharpness(ndf, alpha) / (4 * std::max(c, cos_min))};
}

}  // namespace vsgl
