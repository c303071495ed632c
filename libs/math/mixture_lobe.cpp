#include "math/mixture_lobe.h"

#include <algorithm>
#include <numbers>

namespace vsgl {
namespace {

constexpr double pi = std::numbers::pi;

double squared(double x) {
  return x * x;
}

}  // namespace

MixtureSpread mixture_spread(const SpecularReceiver& r, double sharpness) {
  const double l = std::max(sharpness, 1e-3);
  const double broad = 1 + 0.5 * std::exp(-l);
  const double par = (1 - r.alpha2) * broad * phi(-2 * l) / r.alpha2;
  return {par, par / r.across_cos2, broad, (1 - r.alpha2) / (2 * r.alpha2 * std::max(l, 0.03))};
}

double mixture_direction(std::uint32_t ndf, double sharpness) {
  return std::min(std::max(sharpness, 1e-3) / (ndf == interop::NDF_GGX ? 0.3 : 1), 1.0);
}

HalfVector mixture_half_vector(const SpecularReceiver& r, Vec3 light) {
  const Vec3 h = Vec3{r.sin_view, 0, r.cos_view} + light;
  const double length = std::sqrt(std::max(dot(h, h), 1e-6));
  return {h.x / length, h.y / length};
}

MixtureSplit mixture_split(const SpecularReceiver& r, double sharpness) {
  const double spread = (1 - r.alpha2) / (2 * r.alpha2 * std::sqrt(r.across_cos2)) *
                        std::min(1 / std::max(sharpness, 1e-3), 3.0);
  const double x = std::clamp(1.6 * std::sqrt(spread), 0.01, 100.0);
  return {x, x * (1 + 0.8596 * x) / (1 + x * (1.8105 + 0.3096 * x))};
}

Vec3 mixture_turn(const SpecularReceiver& r, Vec3 light, HalfVector h) {
  const Vec3 view{r.sin_view, 0, r.cos_view}, sum = view + light;
  const Vec3 facet{h.x, h.y, std::sqrt(std::max(1 - squared(h.x) - squared(h.y), 1e-6))};
  if (dot(sum, sum) <= 1e-6) return 2 * dot(view, facet) * facet - sum;
  const Vec3 step = facet - normalise(sum);
  return 2 * dot(view, step) * facet + length(sum) * step;
}

MixturePeak mixture_peak(const SpecularReceiver& r, const MixtureSpread& s, Vec3 light, double sharpness,
                         HalfVector half_vector, double tau, double smith) {
  const double direction = mixture_direction(r.ndf, sharpness);
  const HalfVector h{direction * tau / (tau + s.par) * half_vector.x,
                     direction * tau / (tau + s.perp) * half_vector.y};
  const double cos2 = std::max(1 - squared(h.x) - squared(h.y), 1e-6), z = std::sqrt(cos2);
  const double q = std::max(r.sin_view * h.x + r.cos_view * z, cos_min);
  const Vec3 turn = mixture_turn(r, light, h);
  const double determinant = squared(tau * q) +
                             tau * s.par * (cos2 + squared(q) + squared(r.cos_view - q * z)) +
                             squared(s.par) * cos2;
  const double widening = s.plane / (tau + s.plane) * r.sin_view;
  const double seen = 0.5 * (q + std::sqrt(squared(q) + smith * r.alpha2 * squared(widening)));
  return {h, cos2, 0.5 * std::max(sharpness, 1e-3) * dot(turn, turn),
          s.broad * seen / std::sqrt(determinant)};
}

double mixture_incomplete(double u) {
  const double y = std::min(u, 8.5);
  return 1 / (u * u + 1.9965 + y * (1.362 + y * (-0.662 + y * (0.0908 - 0.0041 * y))));
}

double mixture_tail(const MixtureSpread& s, double x, HalfVector slope2) {
  const double rate = 1.9 * x + 0.25, par = rate + s.par, perp = rate + s.perp;
  const double y = 1 + rate * (slope2.x / par + slope2.y / perp);
  return rate / std::sqrt(par * perp) * mixture_incomplete(y / x) / squared(x);
}

double mixture_density(const SpecularReceiver& r, Vec3 light, double sharpness) {
  const MixtureSpread s = mixture_spread(r, sharpness);
  const HalfVector h = mixture_half_vector(r, light);
  if (r.ndf != interop::NDF_GGX) {
    const MixturePeak peak = mixture_peak(r, s, light, sharpness, h, 1, 1 / pi);
    const double density = ndf_density(r.ndf, r.alpha2, squared(peak.h.x) + squared(peak.h.y), peak.cos2);
    return peak.scale * std::exp(-peak.exponent) * density;
  }
  const double flattening = (1 - r.alpha2) / r.alpha2;
  const MixtureSplit split = mixture_split(r, sharpness);
  const MixturePeak peak = mixture_peak(r, s, light, sharpness, h, split.tau, 1);
  const double exponent = peak.exponent + flattening * (squared(peak.h.x) + squared(peak.h.y)) / split.tau;
  const double direction = mixture_direction(r.ndf, sharpness);
  const HalfVector slope2{flattening * squared(direction * h.x), flattening * squared(direction * h.y)};
  const double core = peak.scale * std::exp(-exponent - 1 / split.x);
  return (core + mixture_tail(s, split.x, slope2)) / (pi * r.alpha2);
}

double specular_vmf_mixture(const SpecularReceiver& r, Vec3 axis, double sharpness) {
  const Vec3 light = specular_local(r, axis);
  const SpecularHorizon horizon = specular_horizon(r, light, sharpness);
  const double masking = 1 + r.view_lambda + smith_lambda(r.ndf, r.alpha2, horizon.cosine);
  return horizon.visible * mixture_density(r, light, sharpness) / (4 * r.cos_view * masking);
}

}  // namespace vsgl
