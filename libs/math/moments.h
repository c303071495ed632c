#pragma once

#include <span>

#include "math/vec.h"

// Merging of the moments of reflecting points in double precision: the twin of shaders/lib/moments.glsl.

namespace vsgl {

// interop::Moments in double precision.
struct DoubleMoments {
  Vec3 flux, power_diffuse, power_specular;  // W
  double weight = 0;
  Vec3 position;      // m
  double spread = 0;  // E|y - mean|^2, m^2
  Vec3 diffuse_mean;
  double diffuse_deficit = 0;
  Vec3 specular_mean;
  double specular_deficit = 0;
  Vec3 normal_mean;
  double normal_deficit = 0;
};

// Law of total variance over `taps`, weighted by `shares` (their sum is 1) and each statistic's own weight.
// Statistics without weight are 0.
DoubleMoments merge_moments(std::span<const DoubleMoments> taps, std::span<const double> shares);

}  // namespace vsgl
