#pragma once

#include <cstdint>
#include <optional>

#include "math/frame.h"

namespace vsgl::reference {

// A microfacet lobe (libs/math/microfacet.h) with one of its two directions fixed, and what depends on that
// alone computed beforehand.
class Specular {
 public:
  Specular() = default;
  // `fixed`: unit, away from the surface.
  Specular(std::uint32_t ndf, double alpha, Vec3 normal, Vec3 fixed);

  // BRDF times the cosine of the unit direction `w`, 1/sr; 0 below the horizon.
  double brdf_cos(Vec3 w) const;

  // [Heitz 2018] A direction reflected by a visible normal of a GGX surface of this roughness, from a point
  // of the unit square. Deviation: stands for Beckmann and Phong lobes as well, whose densities of normals
  // are at most 1.5 times that of GGX.
  Vec3 sample(double u1, double u2) const;
  // Density of sample(), 1/sr.
  double density(Vec3 w) const;

 private:
  std::uint32_t ndf_ = 0;
  double alpha_ = 1, alpha2_ = 1;
  Vec3 normal_, fixed_;
  double cos_ = 1, lambda_ = 0;  // of the fixed direction
  // Of sample(): the fixed direction, at least grazing, and the masking of GGX.
  Vec3 visible_from_;
  double density_scale_ = 0;  // G1 / (4 cos)
};

}  // namespace vsgl::reference
