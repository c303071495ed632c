#pragma once

#include <cstddef>
#include <span>

#include "interop/moments.h"
#include "math/vec.h"

// Merging of the moments of reflecting points in double precision: the twin of shaders/lib/moments.glsl.

namespace vsgl {

// Mean and total central second moment of weighted vectors. Of unit vectors the spread is 1 - |mean|^2.
struct MeanSpread {
  Vec3 mean;
  double spread = 0;
};

// Law of total variance over `count` taps: weight(k), mean(k), spread(k) are those of tap k. Without weight
// all is 0. Two passes: the mean, then spreads about it.
template <class Weight, class Mean, class Spread>
MeanSpread merge_mean_spread(std::size_t count, Weight weight, Mean mean, Spread spread) {
  double total = 0;
  MeanSpread merged;
  for (std::size_t k = 0; k < count; ++k) {
    total += weight(k);
    merged.mean += weight(k) * mean(k);
  }
  if (total <= 0) return {};
  merged.mean = merged.mean / total;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 d = mean(k) - merged.mean;
    merged.spread += weight(k) / total * (spread(k) + dot(d, d));
  }
  return merged;
}

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
DoubleMoments to_double(const interop::Moments& moments);

// Law of total variance over `taps`, weighted by `shares` and each statistic's own weight. Flux, powers and
// weight are the taps' sums times their shares: means where these sum to 1, sums where each is 1. Statistics
// without weight are 0.
DoubleMoments merge_moments(std::span<const DoubleMoments> taps, std::span<const double> shares);

}  // namespace vsgl
