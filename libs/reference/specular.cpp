#include "reference/specular.h"

#include <algorithm>
#include <numbers>

#include "math/microfacet.h"

namespace vsgl::reference {
namespace {

using std::numbers::pi;

// Lowered to grazing incidence from below.
Vec3 above_horizon(Vec3 w, Vec3 normal) {
  const double c = dot(w, normal);
  return c >= cos_min ? w : normalise(w + (cos_min - c) * normal);
}

// Squared tangential and normal parts of a half vector, which need not be normalised.
struct HalfVector {
  double sin2, cos2;
};
HalfVector half_vector(Vec3 a, Vec3 b, Vec3 normal) {
  const Vec3 h = a + b;
  const double hn = dot(h, normal), inverse = 1 / std::max(dot(h, h), 1e-12);
  const Vec3 t = h - hn * normal;
  return {dot(t, t) * inverse, hn * hn * inverse};
}

}  // namespace

Specular::Specular(std::uint32_t ndf, double alpha, Vec3 normal, Vec3 fixed)
    : ndf_(ndf),
      alpha_(alpha),
      alpha2_(alpha * alpha),
      normal_(normal),
      fixed_(fixed),
      cos_(std::max(dot(fixed, normal), cos_min)),
      lambda_(smith_lambda(ndf, alpha2_, cos_)),
      visible_from_(above_horizon(fixed, normal)) {
  const double c = dot(visible_from_, normal);
  density_scale_ = 1 / (4 * c * (1 + ggx_lambda(alpha2_, c)));
}

double Specular::brdf_cos(Vec3 w) const {
  const double cos_w = dot(w, normal_);
  if (cos_w <= 0) return 0;
  const HalfVector h = half_vector(fixed_, w, normal_);
  const double masking = 1 + lambda_ + smith_lambda(ndf_, alpha2_, cos_w);
  return ndf_density(ndf_, alpha2_, h.sin2, h.cos2) / (4 * cos_ * masking);
}

Vec3 Specular::sample(double u1, double u2) const {
  const Frame frame = frame_about(normal_);
  const Vec3 v = frame.to_local(visible_from_);
  const Vec3 stretched = normalise({alpha_ * v.x, alpha_ * v.y, v.z});
  const double across = stretched.x * stretched.x + stretched.y * stretched.y;
  const Vec3 t1 = across > 0 ? Vec3{-stretched.y, stretched.x, 0} / std::sqrt(across) : Vec3{1, 0, 0};
  const Vec3 t2 = cross(stretched, t1);
  // A point of the projection of the hemisphere that is seen from there.
  const double r = std::sqrt(u1), phi = 2 * pi * u2, share = 0.5 * (1 + stretched.z);
  const double p1 = r * std::cos(phi);
  const double p2 = (1 - share) * std::sqrt(1 - p1 * p1) + share * r * std::sin(phi);
  const Vec3 n = p1 * t1 + p2 * t2 + std::sqrt(std::max(0.0, 1 - p1 * p1 - p2 * p2)) * stretched;
  const Vec3 h = normalise({alpha_ * n.x, alpha_ * n.y, std::max(1e-9, n.z)});
  return frame.to_world(2 * dot(v, h) * h - v);
}

double Specular::density(Vec3 w) const {
  if (dot(visible_from_ + w, normal_) <= 0) return 0;
  const HalfVector h = half_vector(visible_from_, w, normal_);
  return density_scale_ * ggx_d(alpha2_, h.sin2, h.cos2);
}

}  // namespace vsgl::reference
