#include "math/vsl.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/frame.h"
#include "math/microfacet.h"

namespace vsgl {
namespace {

Vec3 polar(double sin2, double u) {
  const double sine = std::sqrt(sin2), azimuth = 2 * std::numbers::pi * u;
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), std::sqrt(1 - sin2)};
}

}  // namespace

double disk_cone_height(double d2, double radius2) {
  const double s = std::sqrt(d2 + radius2);
  return radius2 / std::max(s * (s + std::sqrt(d2)), 1e-36);
}

double sphere_cone_height(double d2, double radius2) {
  const double d = std::sqrt(d2);
  return d2 > radius2 ? radius2 / (d * (d + std::sqrt(d2 - radius2))) : 2;
}

Vec3 cone_direction(Vec3 axis, double height, std::array<double, 2> u) {
  const double below = u[0] * height;
  Vec3 local = polar(below * (2 - below), u[1]);
  local.z = 1 - below;
  return frame_about(axis).to_world(local);
}

double microfacet_sin2(std::uint32_t ndf, double alpha2, double u) {
  if (ndf == interop::NDF_GGX) return alpha2 * u / (1 - u + alpha2 * u);
  const double logarithm = std::log1p(-u);
  if (ndf == interop::NDF_PHONG) return -std::expm1(alpha2 * logarithm);
  return alpha2 * logarithm / (alpha2 * logarithm - 1);
}

Vec3 scatter_direction(const Scatterer& s, std::array<double, 2> u) {
  const bool mirrored = u[0] < s.specular;
  const double x = mirrored ? u[0] / s.specular : (u[0] - s.specular) / (1 - s.specular);
  if (!mirrored) return frame_about(s.plane).to_world(polar(std::clamp(x, 0.0, 1.0), u[1]));
  const double sin2 = microfacet_sin2(s.ndf, s.alpha2, std::min(x, 1 - 0x1p-24));
  const Vec3 h = frame_about(s.normal).to_world(polar(std::clamp(sin2, 0.0, 1.0), u[1]));
  const double cosine = dot(s.view, h);
  return cosine > 0 ? 2 * cosine * h - s.view : Vec3{};
}

double scatter_pdf(const Scatterer& s, Vec3 w) {
  const double density = (1 - s.specular) * std::max(dot(w, s.plane), 0.0) / std::numbers::pi;
  if (s.specular <= 0) return density;
  const Vec3 h = s.view + w;
  const double hn = dot(h, s.normal), inverse = 1 / std::max(dot(h, h), 1e-12);
  const Vec3 t = h - hn * s.normal;
  const double facets = ndf_density(s.ndf, s.alpha2, dot(t, t) * inverse, hn * hn * inverse);
  return density + s.specular * facets * std::max(hn, 0.0) * 0.5 * inverse;
}

}  // namespace vsgl
