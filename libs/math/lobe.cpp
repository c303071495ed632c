#include "math/lobe.h"

#include <algorithm>

namespace vsgl {
namespace {

LobeMoments moments_of(Vec3 axis, double one_minus_length) {
  return {(1 - one_minus_length) * axis, one_minus_length * (2 - one_minus_length)};
}

SgLobe lobe_of(Vec3 mean, double sharpness) {
  if (mean == Vec3{}) return {{0, 0, 1}, 0};
  return {normalise(mean), std::min(sharpness, sharpness_max)};
}

}  // namespace

// Newton's method on e^3 + (l - 3) e^2 - 2 l e + 2 = 0 with e = 1 - r: the closed solution by cosines loses
// the digits of e.
double lobe_one_minus_length(double sharpness) {
  const double l = sharpness;
  double e = l < 1 ? 1 / (1 + l / 3) : 1 / (l + 0.5);
  for (int i = 0; i < 8; ++i) {
    const double value = ((e + l - 3) * e - 2 * l) * e + 2;
    const double slope = (3 * e + 2 * (l - 3)) * e - 2 * l;
    e -= value / slope;
  }
  return e;
}

LobeMoments lobe_encode(Vec3 axis, double sharpness) {
  return moments_of(axis, lobe_one_minus_length(sharpness));
}

double lobe_sharpness(double r, double deficit) {
  if (r == 0) return 0;
  return deficit > 0 ? std::min(r * (2 + deficit) / deficit, sharpness_max) : sharpness_max;
}

SgLobe lobe_decode(const LobeMoments& moments) {
  return lobe_of(moments.mean, lobe_sharpness(length(moments.mean), moments.deficit));
}

LobeMoments toksvig_encode(Vec3 axis, double sharpness) {
  return moments_of(axis, 1 / (1 + sharpness));
}

SgLobe toksvig_decode(const LobeMoments& moments) {
  const double r = length(moments.mean);
  return lobe_of(moments.mean, moments.deficit > 0 ? r * (1 + r) / moments.deficit : sharpness_max);
}

}  // namespace vsgl
