#include "math/kernel_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsgl {
namespace {

// The root s in [0, 1] of 4^s (a + (b - a) s) = c, where a < c <= 4 b.
double kernel_fraction(double a, double b, double c) {
  constexpr double ln4 = 2 * std::numbers::ln2;
  const double slope = b - a;
  double s = slope >= 0 ? 1 : 0;
  for (int step = 0; step < 6; ++step) {
    const double p = a + slope * s;
    if (slope >= 0) {
      const double power = std::exp2(2 * s);
      s -= (power * p - c) / (power * (ln4 * p + slope));
    } else {
      s -= (ln4 * s + std::log(p / c)) / (ln4 + slope / p);
    }
  }
  return std::clamp(s, 0.0, 1.0);
}

}  // namespace

double density_bilinear(const DensityPyramid& density, int level, double x, double y) {
  const int last = (density.size >> level) - 1;
  const double tx = x * (last + 1) - 0.5, ty = y * (last + 1) - 0.5;
  const double fx = tx - std::floor(tx), fy = ty - std::floor(ty);
  const int i0 = std::clamp(static_cast<int>(std::floor(tx)), 0, last),
            i1 = std::clamp(static_cast<int>(std::floor(tx)) + 1, 0, last);
  const int j0 = std::clamp(static_cast<int>(std::floor(ty)), 0, last),
            j1 = std::clamp(static_cast<int>(std::floor(ty)) + 1, 0, last);
  return std::lerp(std::lerp(density.at(level, i0, j0), density.at(level, i1, j0), fx),
                   std::lerp(density.at(level, i0, j1), density.at(level, i1, j1), fx), fy);
}

double density_trilinear(const DensityPyramid& density, double level, double x, double y) {
  const int finer = std::min(static_cast<int>(level), density.top());
  const double fine = density_bilinear(density, finer, x, y);
  if (finer == density.top()) return fine;
  return std::lerp(fine, density_bilinear(density, finer + 1, x, y), level - finer);
}

double kernel_level_newton(const DensityPyramid& density, double x, double y, double texels, double share) {
  double p = density_bilinear(density, 0, x, y);
  double wanted = share * texels;
  if (p >= wanted) return 0;
  for (int level = 0; level < density.top(); ++level) {
    const double next = density_bilinear(density, level + 1, x, y);
    if (4 * next >= wanted) return level + kernel_fraction(p, next, wanted);
    p = next;
    wanted *= 0.25;
  }
  return density.top();
}

double kernel_level_bisection(const DensityPyramid& density, double x, double y, double texels, double share,
                              int iterations) {
  double lower = 0, upper = density.top();
  for (int step = 0; step < iterations; ++step) {
    const double level = 0.5 * (lower + upper);
    const double held = std::exp2(2 * level) / texels * density_trilinear(density, level, x, y);
    (held < share ? lower : upper) = level;
  }
  return 0.5 * (lower + upper);
}

double kernel_level_density(double p, int top, double texels, double share) {
  return std::clamp(0.5 * std::log2(share * texels / p), 0.0, static_cast<double>(top));
}

}  // namespace vsgl
