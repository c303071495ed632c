#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "math/frame.h"
#include "math/microfacet.h"

// Numerical integrals that the closed forms of libs/math are tested against.

namespace vsgl::test {

inline constexpr double pi = std::numbers::pi;

// Cosine to the axis at quantile u of the normalised SG.
inline double vmf_quantile(double u, double sharpness) {
  if (sharpness < 1e-9) return 2 * u - 1;
  return 1 + std::log1p(-(1 - u) * -std::expm1(-2 * sharpness)) / sharpness;
}

// Mean over the azimuth of max(a + b cos(azimuth), 0)^power, power 0 or 1, b >= 0.
inline double azimuth_mean_above(double a, double b, int power) {
  const double half = a >= b ? pi : a <= -b ? 0 : std::acos(-a / b);
  return power == 0 ? half / pi : (a * half + b * std::sin(half)) / pi;
}

// Mean of max(w.n, 0)^power under the normalised SG whose axis is at cosine c to n.
inline double vmf_mean_above(double c, double sharpness, int power, int count = 4000) {
  const double s = std::sqrt(std::max(1 - c * c, 0.0));
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double z = vmf_quantile((i + 0.5) / count, sharpness);
    sum += azimuth_mean_above(c * z, s * std::sqrt(std::max(1 - z * z, 0.0)), power);
  }
  return sum / count;
}

// Half vector at quantiles (u, v) of D cos.
inline Vec3 sample_half_vector(std::uint32_t ndf, double alpha2, double u, double v) {
  const double tan2 = ndf == interop::NDF_GGX ? alpha2 * u / (1 - u) : -alpha2 * std::log1p(-u);
  const double cos2 = ndf == interop::NDF_PHONG ? std::pow(1 - u, alpha2) : 1 / (1 + tan2);
  const double sine = std::sqrt(std::max(1 - cos2, 0.0)), angle = 2 * pi * v;
  return {sine * std::cos(angle), sine * std::sin(angle), std::sqrt(cos2)};
}

// Integral of the normalised SG times the specular BRDF times cosine in the tangent frame (normal = +z). Two
// product rules, one centred on the light and one on the normals, joined by the power heuristic.
class SpecularReference {
 public:
  SpecularReference(std::uint32_t ndf, double alpha, Vec3 view, int rows = 48, int columns = 96)
      : ndf_(ndf), alpha_(alpha), view_(view), rows_(rows), columns_(columns) {
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const Vec3 h = sample_half_vector(ndf, alpha * alpha, (i + 0.5) / rows, (j + 0.5) / columns);
        const Vec3 w = 2 * dot(view, h) * h - view;
        if (w.z > 0) samples_.push_back({w, density_of(w), value(w)});
      }
  }

  double integral(Vec3 axis, double sharpness) const {
    const double peak = 1 / sg_integral(sharpness);
    double sum = 0;
    for (const Sample& s : samples_) {
      const double light = peak * sg_value(s.direction, axis, sharpness);
      sum += s.value * light * s.density / (s.density * s.density + light * light);
    }
    const Frame frame = frame_about(axis);
    for (int i = 0; i < rows_; ++i) {
      const double z = vmf_quantile((i + 0.5) / rows_, sharpness), r = std::sqrt(std::max(1 - z * z, 0.0));
      for (int j = 0; j < columns_; ++j) {
        const double angle = 2 * pi * (j + 0.5) / columns_;
        const Vec3 w = frame.to_world({r * std::cos(angle), r * std::sin(angle), z});
        if (w.z <= 0) continue;
        const double light = peak * sg_value(w, axis, sharpness), density = density_of(w);
        sum += value(w) * light * light / (density * density + light * light);
      }
    }
    return sum / (rows_ * columns_);
  }

 private:
  struct Sample {
    Vec3 direction;
    double density, value;
  };

  double value(Vec3 w) const { return specular_brdf_cos(ndf_, alpha_, {0, 0, 1}, view_, w); }
  // Of the directions that reflect `view` at a half vector drawn from D cos.
  double density_of(Vec3 w) const {
    const Vec3 h = normalise(view_ + w);
    const double sin2 = h.x * h.x + h.y * h.y;
    return ndf_density(ndf_, alpha_ * alpha_, sin2, h.z * h.z) * h.z / (4 * dot(view_, h));
  }

  std::uint32_t ndf_;
  double alpha_;
  Vec3 view_;
  int rows_, columns_;
  std::vector<Sample> samples_;
};

// Lights of `sharpness` up to 4 combined lobe widths off the mirror direction of a lobe of sharpness `lobe`, in
// the plane of incidence (x, z), across it and between.
inline std::vector<Vec3> offset_axes(Vec3 mirror, double lobe, double sharpness) {
  const double width = std::min(std::sqrt(1 / std::max(sharpness, 0.5) + 1 / std::max(lobe, 0.5)), 1.0);
  std::vector<Vec3> axes{mirror};
  const Vec3 across{0, 1, 0}, within = cross(mirror, across);
  for (const double offset : {0.5, 1.0, 2.0, 4.0}) {
    const double angle = std::min(offset * width, 0.75 * pi);
    for (const Vec3 side : {within, -within, across, normalise(within + across)})
      axes.push_back(std::cos(angle) * mirror + std::sin(angle) * side);
  }
  return axes;
}

}  // namespace vsgl::test
